// TexelGrid -> .vti without a dense copy: the array's blocks are gathered one by one from the bricks they
// touch.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <span>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "vis/bleed.hpp"
#include "vis/writers.hpp"
#include "vis/xml_document.hpp"

namespace witherfield::vis {
namespace {

constexpr int kEdge = TexelGrid::kEdge;
// Small enough for many blocks to be empty, and for readers to keep one in their fast caches; larger ones compress by a
// few percent better at most.
constexpr std::uint64_t kBlockBytes = 256 * 1024;

/// Where the voxels of a file go, block by block: the same for all of its arrays.
class BlockPlan {
 public:
  struct Voxel {
    std::uint32_t at;   ///< place in the block, in voxels; ascending
    std::int32_t code;  ///< BleedMap's
  };

  BlockPlan(const BleedMap& map, const VoxelBox& box) : size_(box.hi - box.lo) {
    const std::uint64_t row_bytes = std::uint64_t(size_.x) * sizeof(float),
                        rows = voxels() / std::uint64_t(size_.x);
    rows_per_block_ = std::clamp<std::uint64_t>(kBlockBytes / row_bytes, 1, rows);
    blocks_.resize((rows + rows_per_block_ - 1) / rows_per_block_);
    parallel_for(blocks_.size(), 1, [&](std::size_t begin, std::size_t end) {
      std::vector<Voxel> voxels;
      for (std::size_t b = begin; b < end; ++b) {
        voxels.clear();
        plan(map, box, b * rows_per_block_, std::min(rows, (b + 1) * rows_per_block_), voxels);
        blocks_[b].assign(voxels.begin(), voxels.end());
      }
    });
  }

  std::uint64_t voxels() const {
    return std::uint64_t(size_.x) * std::uint64_t(size_.y) * std::uint64_t(size_.z);
  }
  std::uint64_t voxels_per_block() const { return rows_per_block_ * std::uint64_t(size_.x); }
  const std::vector<Voxel>& block(std::size_t b) const { return blocks_[b]; }

 private:
  void plan(const BleedMap& map, const VoxelBox& box, std::uint64_t begin, std::uint64_t end,
            std::vector<Voxel>& out) const {
    const std::uint64_t ny = std::uint64_t(size_.y);
    for (std::uint64_t row = begin; row < end;) {  // the rows of one plane at a time
      const std::uint64_t k = row / ny, stop = std::min(end, (k + 1) * ny);
      const int j_begin = box.lo.y + static_cast<int>(row % ny),
                j_end = j_begin + static_cast<int>(stop - row);
      plan_plane(map, box, box.lo.z + static_cast<int>(k), j_begin, j_end,
                 (row - begin) * std::uint64_t(size_.x), out);
      row = stop;
    }
  }

  /// Rows j_begin .. j_end - 1 of plane k; the first of them starts at `start` in the block.
  void plan_plane(const BleedMap& map, const VoxelBox& box, int k, int j_begin, int j_end,
                  std::uint64_t start, std::vector<Voxel>& out) const {
    const BleedMap::Layer& layer = map.layer(k / kEdge);
    const int slice = (k % kEdge) * kEdge * kEdge;  // first bit of the plane in a brick's mask
    for (int j = j_begin; j < j_end; ++j, start += std::uint64_t(size_.x)) {
      const int row = slice + (j % kEdge) * kEdge;  // first bit of the row
      for (const BleedMap::Brick& b : layer.row(j / kEdge)) {
        const std::int32_t* code = layer.codes.data() + b.first + std::popcount(b.mask & ((1ull << row) - 1));
        for (unsigned bits = (b.mask >> row) & 0xFu; bits; bits &= bits - 1, ++code) {
          const int i = b.x * kEdge + std::countr_zero(bits);
          if (i < box.lo.x || i >= box.hi.x) continue;
          out.push_back({static_cast<std::uint32_t>(start + std::uint64_t(i - box.lo.x)), *code});
        }
      }
    }
  }

  const glm::ivec3 size_;
  std::uint64_t rows_per_block_ = 1;
  std::vector<std::vector<Voxel>> blocks_;
};

using Values = std::span<const std::vector<float>>;  // of the filled voxels, one vector per component

ValueRange range_of(Values values) {
  ValueRange r;
  if (!values[0].empty()) r.lo = r.hi = values[0][0];
  for (const std::vector<float>& component : values)
    for (const float x : component) r = {std::min<double>(r.lo, x), std::max<double>(r.hi, x)};
  return {r.lo + 0.0, r.hi + 0.0};  // no minus zero
}

XmlArray texel_array(const BlockPlan& plan, const TexelField& field, Values values, Compression compression) {
  const std::size_t components = values.size();
  const bool bled = field.first != TexelChannel::density;
  const auto fill = [&](std::size_t block, SparseWords& out) {
    const std::vector<BlockPlan::Voxel>& places = plan.block(block);
    out.at.resize(places.size() * components);
    out.value.resize(out.at.size());
    std::size_t n = 0;
    for (const BlockPlan::Voxel& v : places) {
      if (!bled && !BleedMap::is_filled(v.code)) continue;
      const std::size_t number = static_cast<std::size_t>(BleedMap::number(v.code));
      for (std::size_t c = 0; c < components; ++c, ++n) {
        out.at[n] = static_cast<std::uint32_t>(v.at * components + c);
        out.value[n] = std::bit_cast<std::uint32_t>(values[c][number]);
      }
    }
    out.at.resize(n);
    out.value.resize(n);
  };
  return {std::string(field.name), "Float32", field.components,
          compress_sparse_blocks(plan.voxels() * components, plan.voxels_per_block() * components, compression, fill)};
}

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

struct TexelPlan::Parts {
  Parts(const TexelGrid& grid, const VoxelBox& b) : box((check_box(b, grid.shape()), b)), voxels(grid), plan(BleedMap(voxels), box) {}
  VoxelBox box;
  PackedVoxels voxels;
  BlockPlan plan;
};

TexelPlan::TexelPlan(const TexelGrid& grid, const VoxelBox& box) : parts_(std::make_unique<const Parts>(grid, box)) {}
TexelPlan::~TexelPlan() = default;

ValueRanges write_texel_vti(const std::filesystem::path& file, const TexelGrid& grid, const VoxelBox& box, bool optics,
                            const Stamp& stamp, Compression compression) {
  return write_texel_vti(file, TexelPlan(grid, box), optics, stamp, compression);
}

ValueRanges write_texel_vti(const std::filesystem::path& file, const TexelPlan& texel, bool optics, const Stamp& stamp,
                            Compression compression) {
  const auto& [box, voxels, plan] = texel.parts();
  XmlDocument document = image_document(voxels.grid().shape(), box);
  document.compression = compression;
  std::vector<TexelField> fields;
  std::vector<TexelChannel> channels;
  for (const TexelField& f : texel_fields()) {
    if (f.optics != optics && f.first != TexelChannel::density) continue;
    fields.push_back(f);
    for (int c = 0; c < f.components; ++c)
      channels.push_back(static_cast<TexelChannel>(static_cast<int>(f.first) + c));
  }
  const std::vector<std::vector<float>> values = voxels.values(channels);

  XmlSection section{"PointData", {}};
  ValueRanges ranges;
  std::size_t channel = 0;
  for (const TexelField& f : fields) {
    const Values of_field = Values(values).subspan(channel, std::size_t(f.components));
    section.arrays.push_back(texel_array(plan, f, of_field, compression));
    ranges[std::string(f.name)] = range_of(of_field);
    channel += of_field.size();
  }
  document.sections.push_back(std::move(section));
  add_stamp(document, stamp);
  add_units(document, "mm");
  write_xml_document(file, document);
  return ranges;
}

}  // namespace witherfield::vis
