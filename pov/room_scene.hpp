// Photographs of worn floors: a room lit through its windows, and a flight of stone stairs. Colour, gloss and relief of
// the floor are the simulated fields; the grain of boards and the mottling of stone are drawn on the same pieces that
// wore (sim/core/floor_pattern.hpp).
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sim/core/floor_field.hpp"
#include "sim/core/floor_pattern.hpp"
#include "sim/core/progress.hpp"
#include "sim/core/view.hpp"

namespace witherfield::pov {

/// What is drawn within each piece, and how it mirrors.
enum class FloorMaterial { wood_varnished, wood, stone, tiles, vinyl };

/// How a floor's fields become pictures.
struct FloorLook {
  FloorMaterial material = FloorMaterial::wood_varnished;
  FloorPattern pattern;
  double texture = 1;       ///< contrast of grain, mottling and veins, 0 (bare fields) .. 3
  double relief_scale = 1;  ///< factor on the height of joints and wear, 0..1000; 1 = true to scale
  int map_px = 0;           ///< pixels along the longer side of the maps, 64..8192; 0 = as the picture's size asks
};

enum class OpeningKind { door, window };
/// Hole in a wall, above the segment a-b, which lies on one edge of the outline.
struct WallOpening {
  OpeningKind kind = OpeningKind::door;
  glm::dvec2 a_m{0.0}, b_m{0.0};
  double sill_m = 0;      ///< height of its lower edge, >= 0
  double height_m = 2.03; ///< of the hole, > 0; its upper edge must lie below the ceiling
};

enum class ObstacleKind { desk, bench, cabinet, column };
struct RoomObstacle {
  ObstacleKind kind = ObstacleKind::desk;
  std::vector<glm::dvec2> outline_m;  ///< at least 3 corners
  double height_m = 0.74;             ///< > 0; columns always reach the ceiling
};

/// A chair that stands where people go to; one sits looking to `facing_deg`, counter-clockwise from x.
struct RoomSeat {
  glm::dvec2 at_m{0.0};
  double facing_deg = 90;
};

/// A framed canvas on the wall nearest to a point.
struct WallPicture {
  glm::dvec2 at_m{0.0};
  double width_m = 0.9, height_m = 0.7;  ///< of the canvas, 0.05..10
  double middle_m = 1.5;                 ///< its middle above the floor
};

struct RoomSceneInput {
  Still still;                     ///< `sun` shines through the windows; looks and wd are not used
  const FloorField* floor = nullptr;  ///< channels gloss, dirt, wear_depth_um, height_m, diffuse
  FloorLook look;
  std::vector<glm::dvec2> outline_m;  ///< walls: simple polygon, either sense, at least 3 corners
  double wall_height_m = 2.7;         ///< 1.8..20
  glm::dvec3 wall_rgb{0.74, 0.70, 0.62};  ///< reflectance, linear, 0..0.95
  std::vector<WallOpening> openings;
  std::vector<RoomObstacle> obstacles;
  std::vector<RoomSeat> seats;        ///< those within 1 m of a desk belong to it: its drawers are on their side
  std::vector<WallPicture> pictures;
  double haze = 0;    ///< dust in the air that shows the beams, 0 (none) .. 1
  double lamps = 0.9; ///< soft light from the ceiling, 0..10: fills dark corners
  bool film = false;  ///< no radiosity but fixed fill light: frames differ only where the floor does
};

struct StairSceneInput {
  Still still;
  std::vector<FloorField> treads;   ///< lowest first; x across, y towards the next riser; channels as for a room
  FloorLook look{FloorMaterial::stone, {Laying::slabs, 0.9, 10.0, 0.002, 0, 1}, 1, 1, 0};
  double going_m = 0.30, rise_m = 0.165, width_m = 1.4;  ///< as simulated
  double wall_height_m = 2.6;       ///< of the side walls above the flight, 0.2..20
  glm::dvec3 wall_rgb{0.42, 0.38, 0.31};
  double nosing_m = 0.012;          ///< radius of the front edges, 0..0.05
  bool film = false;
};

/// Writes <still.name>_room.pov and its maps (_height, _albedo, _gloss: 16-bit PNG, east to the right, north up).
/// @throws InvalidInput naming what is wrong (missing channel, polygon, opening off the wall, value out of range),
/// IoFailure.
std::filesystem::path write_room_scene(const std::filesystem::path& folder, const RoomSceneInput& input,
                                       const Progress& progress = {});

/// Writes <still.name>_stairs.pov, the treads' meshes and their maps. The flight climbs along +y from y = 0, x from 0 to
/// width_m, and ends in a landing. @throws as write_room_scene.
std::filesystem::path write_stair_scene(const std::filesystem::path& folder, const StairSceneInput& input,
                                        const Progress& progress = {});

}  // namespace witherfield::pov
