#include "sim/core/texel_grid.hpp"

#include <algorithm>
#include <cstring>

#include "sim/core/errors.hpp"

namespace witherfield {

const std::vector<TexelField>& texel_fields() {
  using C = TexelChannel;
  static const std::vector<TexelField> fields{
      {"density", C::density, 1, false},
      {"water", C::water, 1, false},
      {"chlorophyll_ug_cm2", C::chlorophyll_ug_cm2, 1, false},
      {"stress_vein_MPa", C::stress_vein_MPa, 1, false},
      {"stress_mesophyll_MPa", C::stress_mesophyll_MPa, 1, false},
      {"strain_shrink", C::strain_shrink, 1, false},
      {"tissue", C::tissue, 1, false},
      {"blade_id", C::blade_id, 1, false},
      {"normal", C::normal_x, 3, true},
      {"tangent", C::tangent_x, 3, true},
      {"diffuse", C::diffuse_r, 3, true},
      {"specular", C::specular, 1, true}};
  return fields;
}

TexelGrid::TexelGrid(const GridShape& shape) : shape_(shape) {
  for (int n : {shape.nx, shape.ny, shape.nz})
    if (n <= 0 || n % kEdge != 0)
      throw InvalidInput("TexelGrid: voxels along a side must be a positive multiple of 4, got " + std::to_string(n));
  if (!(shape.spacing_m > 0))
    throw InvalidInput("TexelGrid: spacing must be > 0 m, got " + std::to_string(shape.spacing_m));
  table_.assign(std::size_t(bricks_x()) * bricks_y() * bricks_z(), -1);
}

glm::ivec3 TexelGrid::brick_base(int brick) const {
  const int cell = brick_cell(brick), bx = bricks_x(), by = bricks_y();
  return {(cell % bx) * kEdge, (cell / bx % by) * kEdge, (cell / (bx * by)) * kEdge};
}

float TexelGrid::at(int i, int j, int k, TexelChannel c) const {
  if (i < 0 || j < 0 || k < 0 || i >= shape_.nx || j >= shape_.ny || k >= shape_.nz) return 0.0f;
  const int brick = brick_at(((k / kEdge) * bricks_y() + j / kEdge) * bricks_x() + i / kEdge);
  if (brick < 0) return 0.0f;
  return channel(brick, c)[((k % kEdge) * kEdge + j % kEdge) * kEdge + i % kEdge];
}

void TexelGrid::reset_bricks(const std::vector<int>& cells, bool uninitialised) {
  for (std::int32_t cell : brick_cell_) table_[std::size_t(cell)] = -1;
  brick_cell_.assign(cells.begin(), cells.end());
  for (std::size_t b = 0; b < cells.size(); ++b) table_[std::size_t(cells[b])] = static_cast<std::int32_t>(b);
  const std::size_t floats = cells.size() * kTexelChannels * kVoxels;
  data_.require(floats);
  if (!uninitialised) std::memset(data_.data(), 0, floats * sizeof(float));
}

double TexelGrid::total_density() const {
  double total = 0;
  for (int b = 0; b < brick_count(); ++b) {
    const float* d = channel(b, TexelChannel::density);
    for (int v = 0; v < kVoxels; ++v) total += d[v];
  }
  return total;
}

std::int64_t TexelGrid::occupied_voxels() const {
  std::int64_t n = 0;
  for (int b = 0; b < brick_count(); ++b) {
    const float* d = channel(b, TexelChannel::density);
    n += std::count_if(d, d + kVoxels, [](float x) { return x > 0; });
  }
  return n;
}

std::size_t TexelGrid::memory_bytes() const {
  return table_.capacity() * sizeof(std::int32_t) + brick_cell_.capacity() * sizeof(std::int32_t) +
         data_.size() * sizeof(float);
}

TexelGrid::Box TexelGrid::occupied_box() const {
  Box box{glm::ivec3(shape_.nx, shape_.ny, shape_.nz), glm::ivec3(0)};
  for (int b = 0; b < brick_count(); ++b) {
    const float* d = channel(b, TexelChannel::density);
    const glm::ivec3 base = brick_base(b);
    for (int v = 0; v < kVoxels; ++v) {
      if (!(d[v] > 0)) continue;
      const glm::ivec3 p = base + glm::ivec3(v & 3, (v >> 2) & 3, v >> 4);
      for (int a = 0; a < 3; ++a) {
        box.lo[a] = std::min(box.lo[a], p[a]);
        box.hi[a] = std::max(box.hi[a], p[a] + 1);
      }
    }
  }
  return box.hi.x ? box : Box{};
}

}  // namespace witherfield
