#include "pov/media.hpp"

#include <algorithm>
#include <cmath>

#include "pov/df3.hpp"

namespace witherfield::pov {
namespace {

constexpr int kMostIntervals = 250;  // POV-Ray stops above 254 ("internal nesting limit")

int wrap(int i, int n) {
  return ((i % n) + n) % n;
}

/// Value that a share q of the positive entries does not exceed.
double quantile(std::span<const float> values, double q) {
  std::vector<float> v;
  std::copy_if(values.begin(), values.end(), std::back_inserter(v), [](float x) { return x > 0; });
  if (v.empty()) return 1;
  const auto at = v.begin() + std::ptrdiff_t(q * double(v.size() - 1));
  std::nth_element(v.begin(), at, v.end());
  return *at;
}

void declare(Text& scene, const SceneContext& c, const MediaBlock& b, std::vector<float>& samples,
             double full, const std::string& name, const std::string& map = "") {
  // The lowest layer of grass stands also for the half voxel below it.
  const std::size_t layer = std::size_t(b.nx) * b.ny;
  std::copy_n(samples.begin() + std::ptrdiff_t(layer), layer, samples.begin());
  const std::string file = c.stem + "_" + name + ".df3";
  write_file(c.folder / file, encode_df3(samples, b.nx, b.ny, b.nz, full));
  const double h = b.spacing_m * c.unit;
  // DF3 sample i lies at i/N of the unit cube: scaled to N spacings, the first sample is moved to its place.
  scene << "#declare " << name << "=density{density_file df3 \"" << file << "\" interpolate 1 " << map << "scale <"
        << b.nx * h << "," << b.nz * h << "," << b.ny * h << "> translate " << flip(b.first_m, c.unit)
        << "}\n";
}

std::string interior_text(const MediaNames& names, double per_unit, const glm::dvec3& factor, int intervals) {
  // Method 2, one sample an interval, no jitter: the only setting without bias (jitter is one-sided, method 3
  // never samples the far end of a box and does not attenuate within a step).
  Text head, t;
  head << "media{method 2 intervals max(5,min(" << kMostIntervals << ",int(" << intervals
       << "*IQ))) samples 1,1 jitter 0 ";
  t << "interior{" << head.str() << "absorption " << per_unit * names.full_density << " " << names.density
    << "}\n";
  for (int k = 0; k < 3; ++k) {
    glm::dvec3 e(0.0);
    e[k] = per_unit * names.full_emission * factor[k];
    t << head.str() << "emission rgb" << e << " " << names.emission[k] << "}\n";
  }
  t << "}";
  return t.str();
}

glm::ivec3 block_base(const TexelGrid& grid, bool folded) {
  if (folded) return {grid.shape().margin - 1, grid.shape().margin - 1, -1};
  const TexelGrid::Box box = grid.occupied_box();
  return {box.lo.x - 1, box.lo.y - 1, -1};
}

/// Heights between which a column piece holds grass.
struct Extent {
  int lo = 1 << 30, hi = -1;
};

}  // namespace

MediaBlock media_block(const TexelGrid& grid, bool folded) {
  const GridShape& s = grid.shape();
  const TexelGrid::Box box = grid.occupied_box();
  const glm::ivec3 base = block_base(grid, folded);
  MediaBlock b;
  b.spacing_m = s.spacing_m;
  b.nx = folded ? s.nx - 2 * s.margin + 2 : box.hi.x - box.lo.x + 2;
  b.ny = folded ? s.ny - 2 * s.margin + 2 : box.hi.y - box.lo.y + 2;
  b.nz = box.hi.z + 2;
  b.first_m = s.origin_m + (glm::dvec3(base) + 0.5) * s.spacing_m;
  const glm::dvec3 wall = folded ? glm::dvec3(0.5, 0.5, 0) * s.spacing_m : glm::dvec3(0.0);  // of the tile
  b.box_lo_m = b.first_m + wall;
  b.box_hi_m = b.first_m + glm::dvec3(b.nx - 1, b.ny - 1, b.nz - 1) * s.spacing_m - wall;
  b.box_lo_m.z = s.origin_m.z;
  return b;
}

void add_texel(MediaSamples& samples, const MediaBlock& b, const TexelGrid& grid, const TexelPrelight& light,
               std::span<const glm::vec3> radiance, bool folded) {
  const glm::ivec3 base = block_base(grid, folded);
  for (std::size_t i = 0; i < light.voxels().size(); ++i) {
    const glm::ivec3 p = light.voxels()[i] - base;
    if (!folded) {
      samples.add((std::size_t(p.z) * b.ny + p.y) * b.nx + p.x, light.density()[i], radiance[i]);
      continue;
    }
    // The tile's samples are 1..n; 0 and n + 1 repeat its far sides.
    const int n = b.nx - 2, m = b.ny - 2, x = wrap(p.x - 1, n) + 1, y = wrap(p.y - 1, m) + 1;
    for (const int at_y : {y, y == 1 ? m + 1 : y == m ? 0 : -1})
      for (const int at_x : {x, x == 1 ? n + 1 : x == n ? 0 : -1})
        if (at_x >= 0 && at_y >= 0)
          samples.add((std::size_t(p.z) * b.ny + at_y) * b.nx + at_x, light.density()[i], radiance[i]);
  }
}

std::vector<MediaPiece> find_pieces(const MediaBlock& b, std::span<const float> density, int n) {
  const int px = (b.nx + n - 1) / n, py = (b.ny + n - 1) / n, pz = (b.nz + n - 1) / n;
  std::vector<Extent> extent(std::size_t(px) * py * pz);
  const auto neighbour = [&](int i, int count) { return std::clamp(i, 0, count - 1) / n; };
  for (std::size_t s = 0; s < density.size(); ++s) {
    if (!(density[s] > 0)) continue;
    const int x = int(s % std::size_t(b.nx)), y = int(s / std::size_t(b.nx) % std::size_t(b.ny)),
              z = int(s / (std::size_t(b.nx) * b.ny));
    for (int d = 0; d < 27; ++d) {  // interpolation reaches one sample beyond the grass
      const int bx = neighbour(x + d % 3 - 1, b.nx), by = neighbour(y + d / 3 % 3 - 1, b.ny);
      const int bz = std::clamp(z + d / 9 - 1, 0, b.nz - 1) / n;
      Extent& e = extent[(std::size_t(bz) * py + by) * px + bx];
      e.lo = std::min(e.lo, z - 1);
      e.hi = std::max(e.hi, z + 1);
    }
  }
  std::vector<MediaPiece> pieces;
  const double h = b.spacing_m;
  const auto side = [&](int i, int count, int axis, double& lo, double& hi) {
    lo = i == 0 ? b.box_lo_m[axis] : b.first_m[axis] + i * n * h;
    hi = i + 1 == count ? b.box_hi_m[axis] : b.first_m[axis] + (i + 1) * n * h;
  };
  for (int k = 0; k < pz; ++k)
    for (int j = 0; j < py; ++j)
      for (int i = 0; i < px; ++i) {
        const Extent& e = extent[(std::size_t(k) * py + j) * px + i];
        if (e.hi < 0) continue;
        MediaPiece p;
        p.parity = (i & 1) + 2 * (j & 1) + 4 * (k & 1);
        side(i, px, 0, p.lo_m.x, p.hi_m.x);
        side(j, py, 1, p.lo_m.y, p.hi_m.y);
        p.lo_m.z = std::max(b.box_lo_m.z, b.first_m.z + std::max(k * n, e.lo) * h);
        p.hi_m.z = std::min(b.box_hi_m.z, b.first_m.z + std::min((k + 1) * n, e.hi) * h);
        const glm::dvec3 size = (p.hi_m - p.lo_m) / h;
        p.intervals = std::max(1, int(std::ceil(std::max({size.x, size.y, size.z}) - 1e-6)));
        if (size.x > 0.01 && size.y > 0.01 && size.z > 0.01) pieces.push_back(p);
      }
  return pieces;
}

MediaNames declare_density(Text& scene, const SceneContext& c, const MediaBlock& b, MediaSamples& samples,
                           const std::string& name) {
  MediaNames names;
  names.density = "density{" + name + "D}";
  names.full_density = quantile(samples.density, 0.995);  // the few most crowded voxels are opaque anyhow
  declare(scene, c, b, samples.density, names.full_density, name + "D");
  return names;
}

void declare_emission(Text& scene, const SceneContext& c, const MediaBlock& b, MediaSamples& samples,
                      const std::string& name, MediaNames& names) {
  // Where the density is cut off at full scale, the emission must be cut by the same factor.
  for (auto& channel : samples.emission)
    for (std::size_t s = 0; s < channel.size(); ++s)
      if (samples.density[s] > names.full_density)
        channel[s] *= float(names.full_density) / samples.density[s];
  names.full_emission = 0;
  for (const auto& channel : samples.emission)
    names.full_emission = std::max(names.full_emission, quantile(channel, 0.999));
  for (int k = 0; k < 3; ++k) {
    const std::string channel = name + "RGB"[k];
    names.emission[k] = "density{" + channel + "}";
    declare(scene, c, b, samples.emission[std::size_t(k)], names.full_emission, channel);
  }
}

namespace {

/// Radiance of every sample that holds grass, and of those up to two samples away: means over their neighbours.
std::array<std::vector<float>, 3> spread_radiance(const MediaBlock& b, const MediaSamples& samples) {
  std::array<std::vector<float>, 3> out = samples.emission;
  std::vector<char> known(b.samples(), 0);
  std::vector<std::size_t> edge;
  for (std::size_t s = 0; s < b.samples(); ++s) {
    if (!(samples.density[s] > 0)) continue;
    known[s] = 1;
    edge.push_back(s);
    for (auto& channel : out) channel[s] /= samples.density[s];
  }
  const std::ptrdiff_t step[6] = {1, -1, b.nx, -b.nx, std::ptrdiff_t(b.nx) * b.ny, -std::ptrdiff_t(b.nx) * b.ny};
  // A sample's neighbour in one of the six directions, or none beyond the block.
  const auto neighbour = [&](std::size_t s, int d) -> std::ptrdiff_t {
    const int at[3] = {int(s % std::size_t(b.nx)), int(s / std::size_t(b.nx) % std::size_t(b.ny)),
                       int(s / (std::size_t(b.nx) * b.ny))};
    const int count[3] = {b.nx, b.ny, b.nz};
    const bool beyond = d % 2 == 0 ? at[d / 2] + 1 >= count[d / 2] : at[d / 2] == 0;
    return beyond ? -1 : std::ptrdiff_t(s) + step[d];
  };
  for (int ring = 0; ring < 4; ++ring) {  // four steps along the axes reach two samples along any diagonal's axes
    std::vector<std::size_t> next;
    for (const std::size_t s : edge)
      for (int d = 0; d < 6; ++d)
        if (const std::ptrdiff_t n = neighbour(s, d); n >= 0 && !known[std::size_t(n)]) {
          known[std::size_t(n)] = 2;  // of the ring being made
          next.push_back(std::size_t(n));
        }
    for (const std::size_t s : next) {
      glm::dvec3 sum(0.0);
      int count = 0;
      for (int d = 0; d < 6; ++d)
        if (const std::ptrdiff_t n = neighbour(s, d); n >= 0 && known[std::size_t(n)] == 1) {
          for (int k = 0; k < 3; ++k) sum[k] += out[std::size_t(k)][std::size_t(n)];
          ++count;
        }
      for (int k = 0; k < 3; ++k) out[std::size_t(k)][s] = float(sum[k] / count);
    }
    for (const std::size_t s : next) known[s] = 1;
    edge = std::move(next);
  }
  return out;
}

}  // namespace

MediaNames declare_sharp(Text& scene, const SceneContext& c, const MediaBlock& b, const MediaSamples& samples,
                         const SharpEdge& edge, const std::string& name) {
  MediaNames names;
  names.full_density = quantile(samples.density, 0.995);
  std::vector<float> density = samples.density;
  const std::string opacity = name + "D";
  declare(scene, c, b, density, names.full_density, opacity,
          (Text() << "color_map{[" << edge.none << " rgb 0][" << edge.full << " rgb 1]} ").str());
  names.density = "density{" + opacity + "}";
  std::array<std::vector<float>, 3> radiance = spread_radiance(b, samples);
  double full = 0;
  for (const auto& channel : radiance) full = std::max(full, quantile(channel, 0.999));
  names.full_emission = names.full_density * full;
  for (int k = 0; k < 3; ++k) {
    const std::string channel = name + "RGB"[k];
    declare(scene, c, b, radiance[std::size_t(k)], full, channel);
    names.emission[k] = names.density + "density{" + channel + "}";
  }
  return names;
}

std::string quality_text() {
  return "#declare IQ=(QUALITY=0?0.5:(QUALITY=1?0.75:1.25));\n";
}

std::string boxes_text(const SceneContext& c, const MediaBlock& b, std::span<const MediaPiece> pieces,
                       double overlap, const MediaNames& names, double depth_per_density,
                       const glm::dvec3& factor, const std::string& transform, double height_scale, double per_sample) {
  const double tile = c.input->tile_m, per_unit = depth_per_density / (b.spacing_m * c.unit);
  Text t;
  for (const MediaPiece& piece : pieces) {
    const double over_m = (overlap + kCellOverlaps * kOverlapStep * piece.parity) * tile;
    glm::dvec3 a = piece.lo_m - over_m, z = piece.hi_m + over_m;
    // Above the ground, all by different heights in the world; below the wrap.
    a.z = std::max(a.z, b.box_lo_m.z + over_m / height_scale);
    z.z = std::min(z.z, b.box_hi_m.z - over_m);
    if (!(a.x < z.x && a.y < z.y && a.z < z.z)) continue;
    t << "box{" << flip(a, c.unit) << "," << flip(z, c.unit) << " hollow no_shadow pigment{rgbt 1}\n"
      << interior_text(names, per_unit, factor, int(std::ceil(piece.intervals * per_sample))) << transform << "}\n";
  }
  return t.str();
}

}  // namespace witherfield::pov
