#include "pov/floor_maps.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "pov/room_texture.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"

namespace witherfield::pov {
namespace {

const glm::vec3 kGrime{0.030f, 0.025f, 0.020f};  // what collects in joints and pores
constexpr double kBevel_m = 0.0008;              // worn edge of a piece that catches dirt, beside the joint

/// Bilinear between cell centres, the outermost values beyond.
class Sampler {
 public:
  Sampler(const FloorField& f, glm::dvec2 at) {
    const glm::dvec2 q = glm::clamp((at - f.origin_m) / f.spacing_m - 0.5, glm::dvec2(0), glm::dvec2(f.nx - 1, f.ny - 1));
    const int i = std::min(int(q.x), std::max(0, f.nx - 2)), j = std::min(int(q.y), std::max(0, f.ny - 2));
    const int i1 = std::min(i + 1, f.nx - 1), j1 = std::min(j + 1, f.ny - 1);
    const float a = float(q.x - i), b = float(q.y - j);
    const auto index = [&](int k, int l) { return std::size_t(l) * std::size_t(f.nx) + std::size_t(k); };
    at_[0] = index(i, j), at_[1] = index(i1, j), at_[2] = index(i, j1), at_[3] = index(i1, j1);
    weight_[0] = (1 - a) * (1 - b), weight_[1] = a * (1 - b), weight_[2] = (1 - a) * b, weight_[3] = a * b;
  }
  float operator()(const std::vector<float>& v, std::size_t components = 1, std::size_t c = 0) const {
    float sum = 0;
    for (int k = 0; k < 4; ++k) sum += weight_[k] * v[at_[k] * components + c];
    return sum;
  }

 private:
  std::size_t at_[4];
  float weight_[4];
};

/// The place looked up for the worn fields: ragged, but never across a joint (neighbours wear on their own) nor so near to
/// it that the simulated grid has smeared the joint over it.
glm::dvec2 ragged_place(const FloorLook& look, const FloorPiece& piece, glm::dvec2 place, glm::dvec2 shift, double keep_m) {
  const auto along = [&](double local, double size, double by) {
    const double keep = std::min(keep_m, 0.45 * size);
    return std::clamp(local + by, keep, size - keep) - local;
  };
  if (look.pattern.laying == Laying::seamless) return place + shift;
  const glm::dvec2 d{along(piece.local_m.x, piece.size_m.x, shift.x), along(piece.local_m.y, piece.size_m.y, shift.y)};
  const double a = look.pattern.turn_deg * 3.14159265358979 / 180, c = std::cos(a), s = std::sin(a);
  return place + glm::dvec2(c * d.x - s * d.y, s * d.x + c * d.y);
}

/// Share of a pixel that a band of the given half width around a piece's edge covers; `edge_m` counts from the joint.
float cover(double edge_m, double half_m, double pixel_m) {
  return float(std::clamp((half_m - edge_m) / pixel_m + 0.5, 0.0, 1.0));
}

struct Channels {
  const std::vector<float>&gloss, &dirt, &wear, &height, &diffuse;
};

struct Pixel {
  glm::vec3 albedo;
  float gloss, relief;
};

Pixel pixel_at(const FloorField& field, const Channels& ch, const FloorLook& look, glm::dvec2 place, double pixel_m,
               double level_m) {
  const FloorPiece piece = piece_at(look.pattern, place);
  const Grain g = grain_at(look, piece, pixel_m);
  const Sampler worn(field, ragged_place(look, piece, place, g.ragged_m, 1.0 * field.spacing_m));
  // A joint narrower than a pixel darkens by its share only.
  const double joint_m = look.pattern.laying == Laying::seamless ? 0.0 : look.pattern.joint_m;
  const double narrow = joint_m > 0 ? std::min(1.0, (joint_m + 2 * kBevel_m) / pixel_m) : 0.0;
  const float joint = float(narrow) * cover(piece.edge_m, joint_m > 0 ? kBevel_m : -1e9, pixel_m);
  Pixel out;
  const float dirt = worn(ch.dirt);
  glm::vec3 c{worn(ch.diffuse, 3, 0), worn(ch.diffuse, 3, 1), worn(ch.diffuse, 3, 2)};
  c *= g.tint;
  c = glm::mix(c, kGrime, std::clamp(0.55f * dirt * g.pore * float(look.texture), 0.0f, 1.0f));
  const bool grout = look.material == FloorMaterial::stone || look.material == FloorMaterial::tiles;
  c = glm::mix(c, grout ? c * 0.45f : 0.5f * kGrime, joint);
  out.albedo = glm::clamp(c, 0.0f, 0.95f);
  // What scratched varnish no longer mirrors it scatters: a twentieth of the light, without colour.
  if (look.material == FloorMaterial::wood_varnished)
    out.albedo += 0.05f * (1 - joint) * std::clamp(1.15f * (0.85f - worn(ch.gloss)), 0.0f, 1.0f);
  // Dust and scratches first take the mirror off the low fibres.
  const float gloss = worn(ch.gloss), partly = 4 * gloss * (1 - gloss);
  out.gloss = std::clamp(gloss + 0.14f * partly * (g.fibre - 0.5f) * float(look.texture) - 0.35f * dirt * gloss, 0.0f, 1.0f) *
              (1 - joint);
  // The simulator's height holds wear, levels and joints at its own resolution: wear is taken from there, the joint is drawn
  // sharper.
  const float height = worn(ch.height) - float(level_m) + g.relief_m / (1 + worn(ch.wear) / 100);
  const double deep = look.pattern.joint_m > 0.002 ? 0.0025 : 0.0012;
  out.relief = float(level_m) + float(look.relief_scale) * (height - joint * float(deep) -
                                   float(0.25 * deep * std::exp(-std::max(0.0, piece.edge_m) / 0.003)) * (joint_m > 0));
  return out;
}

}  // namespace

glm::ivec2 map_size(const MapArea& area, int longest) {
  const glm::dvec2 s = area.size_m();
  const double per_m = longest / std::max(s.x, s.y);
  return {std::max(2, int(std::lround(s.x * per_m))), std::max(2, int(std::lround(s.y * per_m)))};
}

FloorMaps make_floor_maps(const FloorField& field, const FloorLook& look, const MapArea& area, glm::ivec2 pixels,
                          double level_m) {
  FloorMaps m;
  m.width = pixels.x, m.height = pixels.y;
  const std::size_t n = std::size_t(pixels.x) * std::size_t(pixels.y);
  m.albedo.resize(n), m.gloss.resize(n), m.relief_m.resize(n);
  const Channels channels{field.at("gloss"), field.at("dirt"), field.at("wear_depth_um"), field.at("height_m"),
                          field.at("diffuse")};
  const glm::dvec2 step = area.size_m() / glm::dvec2(pixels);
  parallel_for(std::size_t(pixels.y), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (int i = 0; i < pixels.x; ++i) {
        const glm::dvec2 place{area.low_m.x + (i + 0.5) * step.x, area.high_m.y - (double(row) + 0.5) * step.y};
        const Pixel p = pixel_at(field, channels, look, place, step.x, level_m);
        const std::size_t k = row * std::size_t(pixels.x) + std::size_t(i);
        m.albedo[k] = p.albedo, m.gloss[k] = p.gloss, m.relief_m[k] = p.relief;
      }
  });
  return m;
}

void check_floor(const FloorField& field, const FloorLook& look, const std::string& what) {
  const auto fail = [&](const std::string& text) { throw InvalidInput(what + ": " + text); };
  try {
    field.validate();
    for (const char* name : {"gloss", "dirt", "wear_depth_um", "height_m", "diffuse"}) (void)field.at(name);
  } catch (const InvalidInput& e) {
    fail(e.what());
  }
  if (!(look.texture >= 0 && look.texture <= 3)) fail("texture must be 0 to 3, got " + std::to_string(look.texture));
  if (!(look.relief_scale >= 0 && look.relief_scale <= 1000))
    fail("relief_scale must be 0 to 1000, got " + std::to_string(look.relief_scale));
  if (look.map_px != 0 && !(look.map_px >= 64 && look.map_px <= 8192))
    fail("map_px must be 0 or 64 to 8192 pixels, got " + std::to_string(look.map_px));
}

FloorMaps make_masonry_maps(const glm::dvec3& rgb, glm::dvec2 size_m, int longest, std::uint64_t seed) {
  FloorLook look{FloorMaterial::stone, {Laying::slabs, 0.52, 0.29, 0.012, 0, seed}, 1.2, 1, 0};
  FloorMaps m;
  const glm::ivec2 pixels = map_size({{0, 0}, size_m}, longest);
  m.width = pixels.x, m.height = pixels.y;
  const std::size_t n = std::size_t(pixels.x) * std::size_t(pixels.y);
  m.albedo.resize(n), m.gloss.assign(n, 0.0f), m.relief_m.resize(n);
  parallel_for(std::size_t(pixels.y), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (int i = 0; i < pixels.x; ++i) {
        const double pixel_m = size_m.x / pixels.x;
        const glm::dvec2 at = glm::dvec2(i + 0.5, pixels.y - double(row) - 0.5) * pixel_m;
        const glm::dvec2 wavy = at + 0.016 * glm::dvec2(cloud_noise(at * 9.0, 3, 5) - 0.5f, cloud_noise(at * 9.0, 3, 6) - 0.5f);
        const FloorPiece piece = piece_at(look.pattern, wavy);
        const Grain g = grain_at(look, piece, pixel_m);
        const float mortar = cover(piece.edge_m, 0.0, 0.006);
        const float face = 0.45f * cloud_noise(at * 16.0, 5, std::uint32_t(piece.id) + 77u) +
                           0.25f * float(piece_random(look.pattern, piece.id, 60));
        const float round = 1 - float(std::exp(-std::max(0.0, piece.edge_m) / 0.015));
        const float stain = cloud_noise({at.x * 1.1, at.y * 0.5}, 4, 31);
        const std::size_t k = row * std::size_t(pixels.x) + std::size_t(i);
        m.relief_m[k] = glm::mix(0.10f + round * (0.2f + face), 0.08f + 0.1f * cloud_noise(at * 40.0, 3, 9), mortar);
        const glm::vec3 block = glm::vec3(rgb) * g.tint * (0.75f + 0.5f * stain) * (0.86f + 0.5f * float(piece_random(look.pattern, piece.id, 61)) * 0.5f);
        m.albedo[k] = glm::clamp(glm::mix(block, glm::vec3(rgb) * 0.72f * (0.8f + 0.4f * stain), mortar), 0.0f, 0.95f);
      }
  });
  return m;
}

}  // namespace witherfield::pov
