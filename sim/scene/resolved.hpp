// Scenes back from what a run keeps of them.
#pragma once
#include <string>

#include "sim/scene/scene.hpp"

namespace witherfield::scene {

/// The scene that resolved_json was made of (its masks' files as they were then).
/// @param what named in messages. @throws InvalidInput.
FloorScene floor_scene_of(const std::string& resolved_json, const std::string& what);

}  // namespace witherfield::scene
