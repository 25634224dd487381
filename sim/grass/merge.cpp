#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/axial.hpp"
#include "sim/grass/points.hpp"

namespace witherfield::grass {
namespace {

constexpr std::size_t kKindGrain = 4, kPairGrain = 256;
constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// The points of one blade and tissue, as a range of `order`.
struct Kind {
  std::uint32_t begin, end;
};

/// Points grouped by blade and tissue (counting sort: within a kind they ascend).
struct Kinds {
  std::vector<std::uint32_t> order;
  std::vector<Kind> ranges;

  explicit Kinds(const PointSet& points) : order(points.size()) {
    const auto [lo, hi] = std::minmax_element(points.blade_id.begin(), points.blade_id.end());
    const std::int64_t first = *lo, blades = std::int64_t(*hi) - *lo + 1;
    constexpr std::int64_t kTissues = 4;
    if (blades > 0x0FFFFFFF)
      throw InvalidInput("merge_points: blade_id spans " + std::to_string(blades) +
                         " values, at most 2^28 - 1");
    const auto kind = [&](std::size_t i) {
      return std::size_t((points.blade_id[i] - first) * kTissues +
                         std::min<std::int64_t>(points.tissue[i], 3));
    };
    std::vector<std::uint32_t> next(std::size_t(blades * kTissues), 0);
    for (std::size_t i = 0; i < order.size(); ++i) ++next[kind(i)];
    std::uint32_t total = 0;
    for (std::uint32_t& n : next) {
      if (n > 1) ranges.push_back({total, total + n});
      total += std::exchange(n, total);
    }
    for (std::size_t i = 0; i < order.size(); ++i) order[next[kind(i)]++] = static_cast<std::uint32_t>(i);
  }
};

/// Nearest neighbours within one kind. A blade is long and thin: sorted along the axis in which it extends
/// furthest, only a handful of points lie within the distance along that axis, and only these are looked at.
class Sweep {
 public:
  /// nearest[i] = the nearest other point nearer than distance_m, of equally near ones the lowest index;
  /// kNone if none.
  void run(const PointSet& points, const Kinds& kinds, Kind kind, double distance_m,
           std::vector<std::uint32_t>& nearest) {
    line_up(points, kinds, kind);
    const double limit2 = distance_m * distance_m;
    best_.assign(line_.size(), {limit2, kNone});
    for (std::size_t a = 0; a < line_.size(); ++a)
      for (std::size_t b = a + 1; b < line_.size() && line_[b].along - line_[a].along < distance_m; ++b) {
        const glm::dvec3 gap = line_[a].position_m - line_[b].position_m;
        const double d2 = glm::dot(gap, gap);
        if (!(d2 < limit2)) continue;
        best_[a] = std::min(best_[a], {d2, line_[b].index});
        best_[b] = std::min(best_[b], {d2, line_[a].index});
      }
    for (std::size_t a = 0; a < line_.size(); ++a) nearest[line_[a].index] = best_[a].second;
  }

 private:
  struct Entry {
    double along;
    std::uint32_t index;
    glm::dvec3 position_m;
  };

  void line_up(const PointSet& points, const Kinds& kinds, Kind kind) {
    glm::dvec3 lo = points.position_m[kinds.order[kind.begin]], hi = lo, sum(0);
    for (std::uint32_t k = kind.begin; k < kind.end; ++k) {
      const glm::dvec3 p = points.position_m[kinds.order[k]];
      lo = glm::min(lo, p), hi = glm::max(hi, p), sum += p;
    }
    if (!std::isfinite(sum.x + sum.y + sum.z))
      throw SolverFailure("merge_points: a position on blade " +
                          std::to_string(points.blade_id[kinds.order[kind.begin]]) + " is not finite");
    const glm::dvec3 extent = hi - lo;
    const int axis = extent.x > extent.y && extent.x > extent.z ? 0 : extent.y > extent.z ? 1 : 2;
    line_.resize(kind.end - kind.begin);
    for (std::uint32_t k = kind.begin; k < kind.end; ++k) {
      const std::uint32_t i = kinds.order[k];
      line_[k - kind.begin] = {points.position_m[i][axis], i, points.position_m[i]};
    }
    std::sort(line_.begin(), line_.end(), [](const Entry& a, const Entry& b) {
      return a.along < b.along || (a.along == b.along && a.index < b.index);
    });
  }

  std::vector<Entry> line_;
  std::vector<std::pair<double, std::uint32_t>> best_;  // squared distance, index
};

/// Axial mean of two directions; the sign follows the heavier one's. Zero vectors (a cone's axis) have no
/// say.
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

/// Drops the points `gone` (ascending); the others keep their order.
void drop(PointSet& p, const std::vector<std::uint32_t>& gone) {
  const std::size_t n = p.size(), kept = n - gone.size();
  const auto squeeze = [&](auto& values) {
    auto to = values.begin() + gone.front();
    for (std::size_t g = 0; g < gone.size(); ++g) {
      const std::size_t next = g + 1 < gone.size() ? gone[g + 1] : n;
      to = std::move(values.begin() + gone[g] + 1, values.begin() + std::ptrdiff_t(next), to);
    }
  };
  squeeze(p.position_m), squeeze(p.velocity_m_s), squeeze(p.mass_kg), squeeze(p.normal), squeeze(p.tangent);
  squeeze(p.blade_id), squeeze(p.arc), squeeze(p.offset), squeeze(p.normal_local), squeeze(p.tissue);
  squeeze(p.water), squeeze(p.chlorophyll_ug_cm2), squeeze(p.stress_vein_MPa),
      squeeze(p.stress_mesophyll_MPa);
  squeeze(p.strain_shrink), squeeze(p.specular), squeeze(p.diffuse);
  p.resize(kept);
}

}  // namespace

std::size_t merge_points(PointSet& points, double distance_m) {
  if (!(distance_m >= 0) || !std::isfinite(distance_m))
    throw InvalidInput("merge_points: distance must be >= 0 m, got " + std::to_string(distance_m));
  const std::size_t n = points.size();
  if (distance_m == 0 || n < 2) return 0;

  const Kinds kinds(points);
  std::vector<std::uint32_t> nearest(n, kNone);
  parallel_for(kinds.ranges.size(), kKindGrain, [&](std::size_t begin, std::size_t end) {
    Sweep sweep;
    for (std::size_t k = begin; k < end; ++k) sweep.run(points, kinds, kinds.ranges[k], distance_m, nearest);
  });

  // Only pairs that are each other's nearest combine: that does not depend on who is asked first.
  std::vector<std::uint32_t> gone;
  for (std::uint32_t j = 0; j < n; ++j)
    if (nearest[j] < j && nearest[nearest[j]] == j) gone.push_back(j);
  parallel_for(gone.size(), kPairGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) combine(points, nearest[gone[g]], gone[g]);
  });
  if (!gone.empty()) drop(points, gone);
  return gone.size();
}

}  // namespace witherfield::grass
