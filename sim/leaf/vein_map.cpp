// Veins as a picture over the texture coordinates.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/leaf/leaf_model.hpp"
#include "sim/leaf/segment_grid.hpp"
#include "sim/leaf/venation.hpp"

namespace witherfield::leaf {
namespace {

/// flat x, y -> uv is a similarity (principal components, scaled alike): found from the model's vertices.
struct UvFrame {
  glm::dvec2 origin{0, 0}, u{0, 0}, v{0, 0};  ///< flat = origin + uv.x * u + uv.y * v
};

UvFrame uv_frame(const Surface& flat) {
  // From three vertices far apart: the first, the one farthest from it in uv, the one farthest from their line.
  const auto& uv = flat.uv;
  std::size_t b = 0, c = 0;
  double far = -1;
  for (std::size_t i = 0; i < uv.size(); ++i)
    if (const double d = glm::distance(uv[i], uv[0]); d > far) far = d, b = i;
  const auto cross = [&](std::size_t i) {
    const glm::dvec2 e = uv[b] - uv[0], f = uv[i] - uv[0];
    return e.x * f.y - e.y * f.x;
  };
  far = -1;
  for (std::size_t i = 0; i < uv.size(); ++i)
    if (std::abs(cross(i)) > far) far = std::abs(cross(i)), c = i;
  if (!(far > 0)) throw InvalidInput("rasterize_veins: the leaf's texture coordinates lie on one line");
  const auto at = [&](std::size_t i) { return glm::dvec2(flat.position_m[i]); };
  const glm::dvec2 e = uv[b] - uv[0], f = uv[c] - uv[0], p = at(b) - at(0), q = at(c) - at(0);
  const double det = e.x * f.y - e.y * f.x;
  UvFrame frame;
  frame.u = (p * f.y - q * e.y) / det;
  frame.v = (q * e.x - p * f.x) / det;
  frame.origin = at(0) - uv[0].x * frame.u - uv[0].y * frame.v;
  return frame;
}

}  // namespace

VeinMap rasterize_veins(const LeafModel& m, int pixels) {
  if (pixels < 16 || pixels > 16384)
    throw InvalidInput("rasterize_veins: " + std::to_string(pixels) + " pixels are outside 16..16384");
  VeinMap map;
  map.pixels = pixels;
  map.vein.assign(std::size_t(pixels) * std::size_t(pixels), 0.0f);
  map.height.assign(map.vein.size(), 1.0f);
  if (m.veins.empty()) return map;
  const UvFrame frame = uv_frame(m.flat);
  const double pixel_m = glm::length(frame.u) / pixels;
  const double half_cell = 0.5 * (m.net_spacing_m > 0 ? m.net_spacing_m : 0.005);
  SegmentGrid grid(std::max(1.2 * half_cell, 0.002));
  for (std::size_t v = 0; v < m.veins.size(); ++v) grid.add_line(m.veins[v].line_m, int(v));
  grid.build();
  parallel_for(std::size_t(pixels), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j)
      for (std::size_t i = 0; i < std::size_t(pixels); ++i) {
        const glm::dvec2 p = frame.origin + (double(i) + 0.5) / pixels * frame.u + (double(j) + 0.5) / pixels * frame.v;
        double vein = 0, nearest = half_cell;
        grid.each(p, [&](const SegmentGrid::Hit& h) {
          const Vein& v = m.veins[std::size_t(h.tag)];
          const double half = 0.5 * (v.width_base_m + (v.width_tip_m - v.width_base_m) * h.along);
          // A soft edge, at least a pixel wide.
          const double q = h.distance_m / (half + 0.6 * pixel_m), edge = std::max(0.0, h.distance_m - half);
          vein = std::max(vein, vein_strength(v.order) * std::exp(-q * q));
          nearest = std::min(nearest, edge);
        });
        const std::size_t at = j * std::size_t(pixels) + i;
        map.vein[at] = float(vein);
        map.height[at] = float(1 - std::pow(1 - std::min(1.0, nearest / half_cell), 2.2));
      }
  });
  return map;
}

}  // namespace witherfield::leaf
