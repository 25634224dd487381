// Pictures of a floor for POV-Ray: colour, gloss and relief on one grid, finer than the simulated one. What the
// simulator cannot know at its resolution (rings of wood, veins of stone, the ragged edge of worn varnish) is drawn
// here, on the same pieces.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "pov/room_scene.hpp"

namespace witherfield::pov {

/// Pixels row by row from the top: x to the right, y up.
struct FloorMaps {
  int width = 0, height = 0;
  std::vector<glm::vec3> albedo;  ///< linear sRGB
  std::vector<float> gloss;       ///< 0 dull .. 1 mirror
  std::vector<float> relief_m;    ///< height, relief_scale applied to all below `level_m`
};

/// Rectangle that maps cover.
struct MapArea {
  glm::dvec2 low_m{0.0}, high_m{1.0};
  glm::dvec2 size_m() const { return high_m - low_m; }
};

/// Pixels of the maps of an area: `longest` along its longer side.
glm::ivec2 map_size(const MapArea& area, int longest);

/// @param level_m height that relief_scale leaves where it is. @pre the field has the channels of RoomSceneInput.
FloorMaps make_floor_maps(const FloorField& field, const FloorLook& look, const MapArea& area, glm::ivec2 pixels,
                          double level_m = 0);

/// @throws InvalidInput naming `what`: a missing channel, a value out of range.
void check_floor(const FloorField& field, const FloorLook& look, const std::string& what);

/// Stone in blocks for walls: colour and relief (0..1) of a periodic-free patch of masonry.
FloorMaps make_masonry_maps(const glm::dvec3& rgb, glm::dvec2 size_m, int longest, std::uint64_t seed);

}  // namespace witherfield::pov
