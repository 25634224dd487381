// Everything of a room but its floor, as POV-Ray text: walls with their openings, frames, ceiling, skirting, obstacles and
// pictures.
#pragma once
#include <string>
#include <vector>

#include "pov/room_scene.hpp"

namespace witherfield::pov {

/// One wall seen from inside: local x runs along it from `a_m`, y is up, z points out of the room.
struct Wall {
  glm::dvec2 a_m{0.0}, along{1, 0}, out{0, 1};
  double length_m = 0;
  double before_m = 0, after_m = 0;  ///< how far the masonry runs on beyond the corners (mitre)
  std::vector<WallOpening> openings; ///< a_m.x and b_m.x: from and to along the wall
  /// POV-Ray's words that put local coordinates into place.
  std::string matrix(double unit) const;
};

inline constexpr double kWallThick_m = 0.30;

/// The walls of the outline, counter-clockwise. @throws InvalidInput: an opening that lies on no wall.
std::vector<Wall> walls_of(const RoomSceneInput& input);

std::string walls_text(const RoomSceneInput& input, const std::vector<Wall>& walls, double unit);
/// Obstacles and seats (room_furniture.cpp).
std::string obstacles_text(const RoomSceneInput& input, double unit);
std::string pictures_text(const RoomSceneInput& input, const std::vector<Wall>& walls, double unit);

/// Sun, skylight at the windows, ceiling lamps; radiosity, or fixed fill light for films.
std::string room_light_text(const RoomSceneInput& input, const std::vector<Wall>& walls, double unit);
/// Twice the signed area: positive when counter-clockwise.
double signed_area(const std::vector<glm::dvec2>& polygon);
/// prism of a polygon (in x, y) between two heights, without its end.
std::string prism_text(const std::vector<glm::dvec2>& polygon, double low_m, double high_m, double unit);

}  // namespace witherfield::pov
