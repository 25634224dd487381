#include "pov/room_texture.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

namespace witherfield::pov {
namespace {

/// A lattice value from three integers: multiply and fold (two rounds mix all bits).
float lattice(std::int32_t i, std::int32_t j, std::uint32_t seed) {
  std::uint64_t h = (std::uint64_t(std::uint32_t(i)) << 32 | std::uint32_t(j)) ^ (std::uint64_t(seed) * 0x9E3779B97F4A7C15u);
  h *= 0xD6E8FEB86659FD93u;
  h ^= h >> 32;
  h *= 0xD6E8FEB86659FD93u;
  h ^= h >> 32;
  return float(h & 0xFFFFFF) * 0x1p-24f;
}

float ramp(float lo, float hi, float x) {
  const float s = std::clamp((x - lo) / (hi - lo), 0.0f, 1.0f);
  return s * s * (3 - 2 * s);
}

/// Numbers that belong to a piece, as drawn here (the simulator's own lie below 32).
struct PieceNumbers {
  const FloorPattern& pattern;
  std::uint64_t id;
  double operator()(std::uint32_t which) const { return piece_random(pattern, id, 40 + which); }
};

/// How much of a detail of the given size a pixel shows.
float seen(double detail_m, double pixel_m) { return ramp(0.8f, 2.5f, float(detail_m / pixel_m)); }

/// A board cut from a log whose axis runs along it, nearly: rings are circles about the axis. Boards cut beside the heart show
/// "cathedrals", those cut through it straight lines. Late wood is the dark, hard end of a ring.
Grain wood(const FloorLook& look, const FloorPiece& piece, double pixel_m) {
  const PieceNumbers r{look.pattern, piece.id};
  const glm::dvec2 at = piece.local_m - 0.5 * piece.size_m;
  const auto seed = std::uint32_t(r(0) * 1e9);
  const double x = at.x, wander = 0.020 * (soft_noise({x * 1.7, r(1) * 9}, seed) - 0.5);
  const double y = at.y + wander + (r(2) - 0.5) * 0.12 + (r(3) - 0.5) * 0.05 * x;
  const double z = 0.015 + 0.13 * r(4) * r(4) + 0.035 * (r(5) - 0.5) * x + 0.012 * (soft_noise({x * 2.3, 5.5}, seed) - 0.5);
  const double ring_m = 0.0030 + 0.0028 * r(6), radius = std::sqrt(y * y + z * z);
  const double rough = 0.45 * (soft_noise({x * 14, y * 140}, seed + 1) - 0.5);
  const double ring = radius / ring_m + 0.8 * soft_noise({x * 3, radius * 60}, seed + 2) + rough;
  const float age = float(ring - std::floor(ring));
  const float shown = seen(ring_m * radius / std::max(0.004, std::abs(y)), pixel_m);
  const float year = lattice(std::int32_t(std::floor(ring)), 7, seed);
  const float late = shown * (0.55f + 0.45f * year) * ramp(0.30f, 0.92f, age) * (1 - ramp(0.93f, 1.0f, age));
  const float fine = soft_noise({at.x * 18, at.y * 900}, seed + 3), coarse = soft_noise({at.x * 5, at.y * 260}, seed + 4);
  const float streak = 0.5f + seen(0.0015, pixel_m) * 0.5f * (fine - 0.5f) + 0.8f * (coarse - 0.5f);
  Grain g;
  g.fibre = std::clamp(0.5f + 0.9f * (streak - 0.5f) + 0.35f * (late - 0.3f), 0.0f, 1.0f);
  g.pore = std::clamp((1 - streak) * 1.1f - 0.2f, 0.0f, 1.0f) * (1 - late);
  const float contrast = float(look.texture), broad = cloud_noise({at.x * 3, at.y * 22}, 3, seed + 5) - 0.5f;
  const glm::vec3 dark = glm::mix(glm::vec3(1.09f, 1.10f, 1.10f), glm::vec3(0.66f, 0.58f, 0.50f), late);
  const glm::vec3 hue = 1.0f + float(r(7) - 0.5) * glm::vec3(0.10f, 0.0f, -0.22f) + float(r(8) - 0.5) * 0.20f;
  g.tint = glm::mix(glm::vec3(1), dark * (0.80f + 0.40f * streak) * (1.0f + 0.35f * broad), contrast) * hue;
  g.relief_m = 12e-6f * (late - 0.3f) + 8e-6f * (streak - 0.5f);
  // Varnish goes along the fibres: worn places end in tongues, board by board.
  g.ragged_m.x = 0.10 * (coarse - 0.5) + 0.07 * (soft_noise({at.x * 9, at.y * 420}, seed + 6) - 0.5);
  g.ragged_m.y = 0.012 * (soft_noise({at.x * 6, at.y * 40}, seed + 7) - 0.5);
  return g;
}

/// Sediment: clouds, bedding, shells and specks; or marble: clouds and veins. Which, and how strong, differs by slab.
Grain stone(const FloorLook& look, const FloorPiece& piece, double pixel_m) {
  const PieceNumbers r{look.pattern, piece.id};
  const auto seed = std::uint32_t(r(0) * 1e9);
  const double turn = 6.283 * r(1), c = std::cos(turn), s = std::sin(turn);
  const glm::dvec2 at{c * piece.local_m.x + s * piece.local_m.y, c * piece.local_m.y - s * piece.local_m.x};
  const float cloud = cloud_noise(at * 5.0, 5, seed), fine = cloud_noise(at * 70.0, 3, seed + 1);
  const float bed = soft_noise({at.x * 2 + 1.5 * cloud, at.y * 26 + 3 * cloud}, seed + 2);
  const float speck = seen(0.006, pixel_m) * ramp(0.68f, 0.80f, cloud_noise(at * 95.0, 2, seed + 3));
  const glm::dvec2 bent = at * 3.2 + 1.1 * glm::dvec2(cloud_noise(at * 4.0, 4, seed + 4), cloud_noise(at * 4.0, 4, seed + 5));
  const float ridge = std::abs(cloud_noise(bent, 3, seed + 6) - 0.5f);
  const float vein = (1 - ramp(0.0f, 0.028f, ridge)) * ramp(0.45f, 0.75f, cloud_noise(at * 2.0, 2, seed + 7));
  Grain g;
  const float contrast = float(look.texture);
  const glm::vec3 shade = glm::vec3(1.0f + 0.55f * (cloud - 0.5f) + 0.22f * (fine - 0.5f) + 0.14f * (bed - 0.5f)) -
                          speck * glm::vec3(0.16f, 0.18f, 0.20f) - vein * glm::vec3(0.20f, 0.22f, 0.22f);
  const glm::vec3 hue = 1.0f + float(r(7) - 0.5) * glm::vec3(0.06f, 0.0f, -0.14f) + float(r(8) - 0.5) * 0.16f;
  g.tint = glm::mix(glm::vec3(1), shade, contrast) * hue;
  g.fibre = std::clamp(0.5f + 1.2f * (fine - 0.5f) + 0.6f * (cloud - 0.5f), 0.0f, 1.0f);
  g.pore = std::max(speck, ramp(0.60f, 0.85f, fine));
  g.relief_m = 60e-6f * (fine - 0.5f) - 40e-6f * speck;
  g.ragged_m = 0.02 * glm::dvec2(fine - 0.5f, cloud_noise(at * 60.0, 3, seed + 8) - 0.5f);
  return g;
}

/// Fired or rolled stock: hardly any drawing, every piece a shade of its own.
Grain plain(const FloorLook& look, const FloorPiece& piece, double pixel_m) {
  const PieceNumbers r{look.pattern, piece.id};
  const bool vinyl = look.material == FloorMaterial::vinyl;
  const auto seed = std::uint32_t(r(0) * 1e9);
  const float cloud = cloud_noise(piece.local_m * 9.0, 4, seed), chip = soft_noise(piece.local_m * 150.0, seed + 1);
  const float chips = vinyl ? seen(0.006, pixel_m) * (ramp(0.72f, 0.80f, chip) - ramp(0.28f, 0.20f, chip)) : 0.0f;
  Grain g;
  g.tint = glm::vec3(1.0f + float(look.texture) * (0.16f * (cloud - 0.5f) + 0.22f * chips)) * (1.0f + 0.10f * float(r(8) - 0.5));
  g.fibre = std::clamp(0.5f + 0.8f * (cloud - 0.5f), 0.0f, 1.0f);
  g.pore = ramp(0.62f, 0.9f, chip);
  g.ragged_m = 0.012 * glm::dvec2(cloud - 0.5f, chip - 0.5f);
  return g;
}

}  // namespace

float soft_noise(glm::dvec2 at, std::uint32_t seed) {
  const double fi = std::floor(at.x), fj = std::floor(at.y);
  const auto i = std::int32_t(fi), j = std::int32_t(fj);
  const float a = float(at.x - fi), b = float(at.y - fj), u = a * a * (3 - 2 * a), v = b * b * (3 - 2 * b);
  return glm::mix(glm::mix(lattice(i, j, seed), lattice(i + 1, j, seed), u),
                  glm::mix(lattice(i, j + 1, seed), lattice(i + 1, j + 1, seed), u), v);
}

float cloud_noise(glm::dvec2 at, int octaves, std::uint32_t seed) {
  float sum = 0, weight = 0, w = 1;
  for (int k = 0; k < octaves; ++k) {
    sum += w * soft_noise(at, seed + 101u * std::uint32_t(k));
    weight += w;
    w *= 0.55f;
    at = glm::dvec2(1.6 * at.x + 1.2 * at.y, 1.6 * at.y - 1.2 * at.x);  // twice as fine, turned: no lattice shows
  }
  return sum / weight;
}

Grain grain_at(const FloorLook& look, const FloorPiece& piece, double pixel_m) {
  switch (look.material) {
    case FloorMaterial::wood:
    case FloorMaterial::wood_varnished:
      return wood(look, piece, pixel_m);
    case FloorMaterial::stone:
      return stone(look, piece, pixel_m);
    case FloorMaterial::tiles:
    case FloorMaterial::vinyl:
      break;
  }
  return plain(look, piece, pixel_m);
}

}  // namespace witherfield::pov
