// What the picture writers need to know of a floor scene: the room or the stairs of a still.
#pragma once
#include <span>
#include <vector>

#include "pov/room_scene.hpp"
#include "sim/scene/scene.hpp"

namespace witherfield::cli {

/// The room as it stands at the still's moment, with this floor, which must outlive what is returned.
pov::RoomSceneInput room_input(const scene::FloorScene& scene, const scene::RoomStill& still, const FloorField& floor);

/// @pre scene.floor.stairs. @param treads lowest first.
pov::StairSceneInput stair_input(const scene::FloorScene& scene, const scene::RoomStill& still,
                                 std::vector<FloorField> treads);

/// The treads of a flight laid out in its plan, one behind the other; a room's floor as it is.
FloorField in_plan(std::span<const FloorField> floors);
/// The treads again, `going_m` apart. @throws IoFailure when the plan does not divide into so many.
std::vector<FloorField> treads_of(const FloorField& plan, int treads, double going_m);

}  // namespace witherfield::cli
