// TexelGrid -> .vti without a dense copy: the array's blocks are gathered one by one from the bricks they
// touch.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "sim/core/errors.hpp"
#include "vis/bleed.hpp"
#include "vis/writers.hpp"
#include "vis/xml_document.hpp"

namespace witherfield::vis {
namespace {

constexpr int kEdge = TexelGrid::kEdge, kVoxels = TexelGrid::kVoxels;
// Small enough for a block to stay in the fast caches between gathering and compressing, and for many to be
// empty; larger ones compress by a few percent better at most.
constexpr std::uint64_t kBlockBytes = 256 * 1024;

/// Labels are kept as they are: rounding would merge neighbouring blade ids above 2048.
bool is_label(const TexelField& f) {
  return f.first == TexelChannel::blade_id || f.first == TexelChannel::tissue;
}

/// One array of the file: its values in file order, block by block.
class TexelArray {
 public:
  TexelArray(const TexelGrid& grid, const BleedMap& map, const VoxelBox& box, const TexelField& field)
      : grid_(grid), map_(map), box_(box), field_(field), size_(box.hi - box.lo) {
    rows_ = std::uint64_t(size_.y) * std::uint64_t(size_.z);
    rows_per_block_ = std::clamp<std::uint64_t>(kBlockBytes / row_bytes(), 1, rows_);
    ranges_.resize((rows_ + rows_per_block_ - 1) / rows_per_block_);
  }

  XmlArray compress(Compression compression) {
    XmlArray out{std::string(field_.name), "Float32", field_.components, {}};
    out.data =
        compress_blocks(rows_ * row_bytes(), rows_per_block_ * row_bytes(), compression,
                        [this](std::size_t block, std::span<std::byte> bytes) {
                          return fill(block, {reinterpret_cast<float*>(bytes.data()), bytes.size() / 4});
                        });
    return out;
  }

  /// Of the filled voxels as written. Valid after compress(). {0, 0} when there are none.
  ValueRange range() const {
    MinMax all;
    for (const MinMax& r : ranges_) all = {std::min(all.lo, r.lo), std::max(all.hi, r.hi)};
    return all.lo <= all.hi ? ValueRange{all.lo, all.hi} : ValueRange{};
  }

 private:
  struct MinMax {
    float lo = std::numeric_limits<float>::infinity(), hi = -std::numeric_limits<float>::infinity();
  };

  std::uint64_t row_bytes() const {
    return std::uint64_t(size_.x) * std::uint64_t(field_.components) * sizeof(float);
  }

  bool fill(std::size_t block, std::span<float> out) {
    const std::uint64_t row_floats = row_bytes() / sizeof(float), ny = std::uint64_t(size_.y);
    const std::uint64_t begin = block * rows_per_block_, end = begin + out.size() / row_floats;
    bool any = false;
    for (std::uint64_t row = begin; row < end;) {  // the rows of one k at a time
      const std::uint64_t k = row / ny, stop = std::min(end, (k + 1) * ny);
      const int j_begin = box_.lo.y + static_cast<int>(row % ny),
                j_end = j_begin + static_cast<int>(stop - row);
      any |= fill_rows(box_.lo.z + static_cast<int>(k), j_begin, j_end,
                       out.subspan((row - begin) * row_floats, (stop - row) * row_floats), ranges_[block]);
      row = stop;
    }
    return any;
  }

  /// Rows j_begin .. j_end - 1 of plane k. Clears `out` first, even when it then returns false for want of
  /// voxels.
  bool fill_rows(int k, int j_begin, int j_end, std::span<float> out, MinMax& range) {
    std::fill(out.begin(), out.end(), 0.0f);
    const BleedMap::Layer& layer = map_.layer(k / kEdge);
    const int slice = (k % kEdge) * kEdge * kEdge;  // first bit of the plane in a brick's mask
    bool any = false;
    for (int by = j_begin / kEdge; by <= (j_end - 1) / kEdge; ++by)
      for (const BleedMap::Brick& b : layer.row(by)) {
        const std::int32_t* code =
            layer.codes.data() + b.first + std::popcount(b.mask & ((1ull << slice) - 1));
        for (unsigned bits = (b.mask >> slice) & 0xFFFFu; bits; bits &= bits - 1, ++code) {
          const int v = std::countr_zero(bits), j = by * kEdge + v / kEdge, i = b.x * kEdge + v % kEdge;
          if (j < j_begin || j >= j_end || i < box_.lo.x || i >= box_.hi.x) continue;
          put(*code,
              out.data() + (std::size_t(j - j_begin) * std::size_t(size_.x) + std::size_t(i - box_.lo.x)) *
                               std::size_t(field_.components),
              range);
          any = true;
        }
      }
    return any;
  }

  void put(std::int32_t code, float* out, MinMax& range) const {
    const bool filled = BleedMap::is_filled(code);
    if (is_density_ && !filled) return;
    const int place = BleedMap::place(code);
    for (int c = 0; c < field_.components; ++c) {
      const auto channel = static_cast<TexelChannel>(static_cast<int>(field_.first) + c);
      const float raw = grid_.channel(place / kVoxels, channel)[place % kVoxels];
      const float value = is_label_ ? raw : round_mantissa(raw);
      out[c] = value;
      if (!filled) continue;
      range.lo = std::min(range.lo, value);
      range.hi = std::max(range.hi, value);
    }
  }

  const TexelGrid& grid_;
  const BleedMap& map_;
  const VoxelBox box_;
  const TexelField field_;
  const glm::ivec3 size_;
  const bool is_density_ = field_.first == TexelChannel::density, is_label_ = is_label(field_);
  std::uint64_t rows_ = 0, rows_per_block_ = 0;
  std::vector<MinMax> ranges_;
};

void check_box(const VoxelBox& box, const GridShape& shape) {
  const glm::ivec3 n{shape.nx, shape.ny, shape.nz};
  for (int a = 0; a < 3; ++a)
    if (box.lo[a] < 0 || box.hi[a] > n[a] || box.lo[a] >= box.hi[a])
      throw InvalidInput(
          fmt::format("write_texel_vti: box along {} is [{}, {}), must be a non-empty part of [0, {}) voxels",
                      "xyz"[a], box.lo[a], box.hi[a], n[a]));
}

XmlDocument image_document(const GridShape& shape, const VoxelBox& box) {
  const glm::ivec3 size = box.hi - box.lo;
  const std::string extent = fmt::format("0 {} 0 {} 0 {}", size.x - 1, size.y - 1, size.z - 1);
  // The first point is the centre of the box's first voxel; millimetres.
  const auto origin = [&](int a) { return (shape.origin_m[a] + (box.lo[a] + 0.5) * shape.spacing_m) * 1e3; };
  XmlDocument d;
  d.type = "ImageData";
  d.type_attributes = fmt::format(
      R"( WholeExtent="{0}" Origin="{1} {2} {3}" Spacing="{4} {4} {4}" Direction="1 0 0 0 1 0 0 0 1")",
      extent, origin(0), origin(1), origin(2), shape.spacing_m * 1e3);
  d.piece_attributes = fmt::format(R"( Extent="{}")", extent);
  return d;
}

}  // namespace

void merge_ranges(ValueRanges& into, const ValueRanges& from) {
  for (const auto& [name, r] : from) {
    const auto [at, added] = into.try_emplace(name, r);
    if (!added) at->second = {std::min(at->second.lo, r.lo), std::max(at->second.hi, r.hi)};
  }
}

ValueRanges write_texel_vti(const std::filesystem::path& file, const TexelGrid& grid, const VoxelBox& box,
                            bool optics, const Stamp& stamp, Compression compression) {
  check_box(box, grid.shape());
  const BleedMap map(grid);
  XmlDocument document = image_document(grid.shape(), box);
  document.compression = compression;
  XmlSection section{"PointData", {}};
  ValueRanges ranges;
  for (const TexelField& field : texel_fields()) {
    if (field.optics != optics && field.first != TexelChannel::density) continue;
    TexelArray array(grid, map, box, field);
    section.arrays.push_back(array.compress(compression));
    ranges[std::string(field.name)] = array.range();
  }
  document.sections.push_back(std::move(section));
  add_stamp(document, stamp);
  add_units(document, "mm");
  write_xml_document(file, document);
  return ranges;
}

}  // namespace witherfield::vis
