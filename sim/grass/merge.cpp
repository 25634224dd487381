#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/axial.hpp"
#include "sim/grass/points.hpp"

namespace witherfield::grass {
namespace {

constexpr std::size_t kGrain = 2048;
constexpr std::uint32_t kNone = 0xFFFFFFFFu;

using Cell = glm::i64vec3;

/// A hash grid of points. Cells are two search distances wide, so that a ball of that radius around any point
/// meets at most two cells along each axis.
class PointHash {
 public:
  PointHash(const PointSet& points, double distance_m) : points_(points), cell_m_(2 * distance_m) {
    const std::size_t n = points.size();
    std::size_t buckets = 64;
    while (buckets < n) buckets *= 2;
    mask_ = buckets - 1;
    std::vector<std::uint32_t> bucket(n);
    parallel_for(n, kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        bucket[i] = bucket_of(cell_at(points.position_m[i]), kind(i));
    });
    start_.assign(buckets + 1, 0);  // counting sort by bucket; within a bucket the points ascend
    for (std::size_t i = 0; i < n; ++i) ++start_[bucket[i] + 1];
    for (std::size_t b = 0; b < buckets; ++b) start_[b + 1] += start_[b];
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    entries_.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      entries_[next[bucket[i]]++] = {points.position_m[i], kind(i), static_cast<std::uint32_t>(i)};
  }

  /// The nearest other point of the same blade and tissue nearer than distance_m; of equally near ones the lowest index.
  std::uint32_t nearest(std::size_t i, double distance_m) const {
    const glm::dvec3 p = points_.position_m[i];
    const std::uint64_t own = kind(i);
    const Cell lo = cell_at(p - distance_m), hi = cell_at(p + distance_m);
    std::uint32_t best = kNone;
    double best_d2 = distance_m * distance_m;
    for (auto z = lo.z; z <= hi.z; ++z)
      for (auto y = lo.y; y <= hi.y; ++y)
        for (auto x = lo.x; x <= hi.x; ++x) {
          const std::size_t b = bucket_of({x, y, z}, own);
          for (std::uint32_t e = start_[b]; e < start_[b + 1]; ++e) {
            const Entry& other = entries_[e];
            if (other.kind != own || other.index == i) continue;
            const glm::dvec3 gap = other.position_m - p;
            const double d2 = glm::dot(gap, gap);
            if (d2 < best_d2 || (d2 == best_d2 && best != kNone && other.index < best))
              best = other.index, best_d2 = d2;
          }
        }
    return best;
  }

 private:
  struct Entry {
    glm::dvec3 position_m;
    std::uint64_t kind;
    std::uint32_t index;
  };

  std::uint64_t kind(std::size_t i) const {
    return std::uint64_t(std::uint32_t(points_.blade_id[i])) << 8 | points_.tissue[i];
  }
  Cell cell_at(const glm::dvec3& p) const { return Cell(glm::floor(p / cell_m_)); }

  std::uint32_t bucket_of(const Cell& c, std::uint64_t kind) const {
    std::uint64_t h = std::uint64_t(c.x) * 0x9E3779B97F4A7C15u + std::uint64_t(c.y) * 0xC2B2AE3D27D4EB4Fu +
                      std::uint64_t(c.z) * 0x165667B19E3779F9u + kind * 0xD6E8FEB86659FD93u;
    h = (h ^ (h >> 32)) * 0xD6E8FEB86659FD93u;
    return static_cast<std::uint32_t>((h ^ (h >> 32)) & mask_);
  }

  const PointSet& points_;
  double cell_m_;
  std::size_t mask_ = 0;
  std::vector<std::uint32_t> start_;
  std::vector<Entry> entries_;
};

/// Axial mean of two directions; the sign follows the heavier one's. Zero vectors (a cone's axis) have no say.
glm::vec3 axial_mean(const glm::vec3& a, double mass_a, const glm::vec3& b, double mass_b) {
  float dyads[6] = {};
  const double total = mass_a + mass_b;
  add_dyad(dyads, float(mass_a / total), a);
  add_dyad(dyads, float(mass_b / total), b);
  const bool b_leads = mass_b > mass_a || a == glm::vec3(0.0f);
  return principal_axis(dyads, b_leads ? b : a);
}

/// Puts the combination of points i and j in place of i.
void combine(PointSet& p, std::size_t i, std::size_t j) {
  const double mi = p.mass_kg[i], mj = p.mass_kg[j], share = mj / (mi + mj);
  const float f = static_cast<float>(share);
  const auto mean = [&](auto& values) { values[i] += (values[j] - values[i]) * f; };
  p.position_m[i] += (p.position_m[j] - p.position_m[i]) * share;
  p.velocity_m_s[i] =
      glm::vec3(glm::dvec3(p.velocity_m_s[i]) * (1 - share) + glm::dvec3(p.velocity_m_s[j]) * share);
  p.tangent[i] = axial_mean(p.tangent[i], mi, p.tangent[j], mj);
  p.normal[i] = axial_mean(p.normal[i], mi, p.normal[j], mj);
  p.normal_local[i] = axial_mean(p.normal_local[i], mi, p.normal_local[j], mj);
  mean(p.arc), mean(p.offset), mean(p.water), mean(p.chlorophyll_ug_cm2), mean(p.stress_vein_MPa);
  mean(p.stress_mesophyll_MPa), mean(p.strain_shrink), mean(p.specular), mean(p.diffuse);
  p.mass_kg[i] = mi + mj;
}

/// Drops the points marked in `gone`; the others keep their order.
void drop(PointSet& p, const std::vector<std::uint8_t>& gone) {
  std::size_t kept = 0;
  const auto squeeze = [&](auto& values) {
    kept = 0;
    for (std::size_t i = 0; i < gone.size(); ++i)
      if (!gone[i]) values[kept++] = values[i];
  };
  squeeze(p.position_m), squeeze(p.velocity_m_s), squeeze(p.mass_kg), squeeze(p.normal), squeeze(p.tangent);
  squeeze(p.blade_id), squeeze(p.arc), squeeze(p.offset), squeeze(p.normal_local), squeeze(p.tissue);
  squeeze(p.water), squeeze(p.chlorophyll_ug_cm2), squeeze(p.stress_vein_MPa), squeeze(p.stress_mesophyll_MPa);
  squeeze(p.strain_shrink), squeeze(p.specular), squeeze(p.diffuse);
  p.resize(kept);
}

}  // namespace

std::size_t merge_points(PointSet& points, double distance_m) {
  if (!(distance_m >= 0) || !std::isfinite(distance_m))
    throw InvalidInput("merge_points: distance must be >= 0 m, got " + std::to_string(distance_m));
  const std::size_t n = points.size();
  if (distance_m == 0 || n < 2) return 0;

  const PointHash hash(points, distance_m);
  std::vector<std::uint32_t> nearest(n);
  parallel_for(n, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) nearest[i] = hash.nearest(i, distance_m);
  });

  // Only pairs that are each other's nearest combine: that does not depend on who is asked first.
  std::vector<std::uint8_t> gone(n, 0);
  std::size_t merges = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t j = nearest[i];
    if (j == kNone || j <= i || nearest[j] != i) continue;
    combine(points, i, j);
    gone[j] = 1;
    ++merges;
  }
  if (merges) drop(points, gone);
  return merges;
}

}  // namespace witherfield::grass
