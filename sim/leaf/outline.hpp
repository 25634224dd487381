// Points on the outline and the main vein of a leaf: measured, from the veins' proportions, or set by hand.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace witherfield::leaf {

/// Three groups, each from the petiole to the tip (Miao et al., sec. 1: the counts tell the groups apart). The left and
/// right groups need not contain the base and tip points: base = first and tip = last point of the midrib.
struct OutlinePoints {
  std::vector<glm::dvec3> left_m, right_m, midrib_m;
  bool empty() const { return left_m.empty() && right_m.empty() && midrib_m.empty(); }
};

/// Lines `group,x,y,z` (metres; group = left, right or midrib; z may be missing), in order from base to tip. A first line
/// with names, empty lines and lines that begin with # are passed over. `unit` of the numbers: m, cm or mm.
/// @throws InvalidInput with `name` and the line number.
OutlinePoints parse_outline_csv(std::string_view text, const std::string& name, const std::string& unit = "m");
/// An object {"left": [[x, y], [x, y, z], ...], "right": [...], "midrib": [...]}; its "unit", when stated, goes before `unit`.
/// @throws InvalidInput with `name`, the line of a mistake in the notation, the group and number of a wrong point.
OutlinePoints parse_outline_json(std::string_view text, const std::string& name, const std::string& unit = "m");
std::string outline_csv(const OutlinePoints& points);

/// @throws InvalidInput for another unit than m, cm, mm.
double metres_per_unit(const std::string& unit);

/// @throws InvalidInput: fewer than 2 points on an outline or on the midrib, not finite, points that coincide, all on
/// one line, left and right swapped.
void validate(const OutlinePoints& points);

/// Points taken from a closed outline as a person would: `count` on either side, evenly along it between base and tip.
/// @param outline_m counter-clockwise, not repeated; `base`, `tip`: numbers of its points.
OutlinePoints sample_outline(const std::vector<glm::dvec2>& outline_m, int base, int tip, int count, int midrib_count);

}  // namespace witherfield::leaf
