// Points that ride on blades: where each sits in the frame of its blade, and where the blade carries it.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/points.hpp"

namespace witherfield::grass {
namespace {

constexpr std::size_t kGrain = 2048;
constexpr double kSecondsPerDay = 86400;

/// A spot of a centre line: between nodes `node` and `node + 1`, at fraction `t` of the way.
struct Spot {
  std::size_t node;
  double t;
};

Spot spot_at(const BladeState& state, int blade, double arc) {
  const double s = std::clamp(arc, 0.0, 1.0) * state.segments;
  const int k = std::min(static_cast<int>(s), state.segments - 1);
  return {std::size_t(blade) * std::size_t(state.nodes_per_blade()) + std::size_t(k), s - k};
}

template <class T>
auto between(const std::vector<T>& values, Spot spot) {
  const auto a = values[spot.node], b = values[spot.node + 1];
  using Real = std::conditional_t<std::is_same_v<T, glm::dvec3> || std::is_same_v<T, double>, double, float>;
  return a + (b - a) * static_cast<Real>(spot.t);
}

struct Frame {
  glm::dvec3 side, normal, tangent;

  glm::dvec3 to_world(const glm::dvec3& local) const {
    return side * local.x + normal * local.y + tangent * local.z;
  }
  glm::dvec3 to_local(const glm::dvec3& world) const {
    return {glm::dot(side, world), glm::dot(normal, world), glm::dot(tangent, world)};
  }
};

/// Interpolated and made orthonormal again. Frames of neighbouring nodes are less than a right angle apart.
Frame frame_at(const BladeState& state, Spot spot) {
  Frame f;
  f.tangent = glm::normalize(between(state.tangent, spot));
  const glm::dvec3 side = between(state.side, spot);
  f.side = glm::normalize(side - f.tangent * glm::dot(side, f.tangent));
  f.normal = blade_normal(f.tangent, f.side);
  return f;
}

void check(const char* where, const PointSet& points, const BladeState& state, int first_blade_id) {
  const std::size_t nodes = state.node_m.size();
  if (state.segments < 1 || nodes % std::size_t(state.nodes_per_blade()) != 0 ||
      state.tangent.size() != nodes || state.side.size() != nodes)
    throw InvalidInput(std::string(where) + ": blade state with " + std::to_string(nodes) + " nodes, " +
                       std::to_string(state.tangent.size()) + " tangents and " +
                       std::to_string(state.side.size()) + " sides is not whole blades of " +
                       std::to_string(state.segments) + " segments");
  const auto [lo, hi] = std::minmax_element(points.blade_id.begin(), points.blade_id.end());
  if (lo == points.blade_id.end()) return;
  const int last = first_blade_id + state.blade_count() - 1;
  if (*lo < first_blade_id || *hi > last)
    throw InvalidInput(std::string(where) + ": blade_id " + std::to_string(*lo < first_blade_id ? *lo : *hi) +
                       " is outside " + std::to_string(first_blade_id) + ".." + std::to_string(last));
}

/// The nearest spot of one blade's centre line to `p`. Looks at segments around `guess`, and further as long
/// as the nearest is at the rim of what was looked at.
class NearestSegment {
 public:
  NearestSegment(const BladeState& state, int blade, const glm::dvec3& p)
      : state_(state), first_(std::size_t(blade) * std::size_t(state.nodes_per_blade())), p_(p) {}

  double arc_near(int guess) {
    constexpr int kReach = 2;
    int lo = std::max(guess - kReach, 0), hi = std::min(guess + kReach, state_.segments - 1);
    for (int k = lo; k <= hi; ++k) look_at(k);
    while (best_ == lo && lo > 0) {
      const int from = std::max(lo - kReach, 0);
      for (int k = lo - 1; k >= from; --k) look_at(k);
      lo = from;
    }
    while (best_ == hi && hi < state_.segments - 1) {
      const int to = std::min(hi + kReach, state_.segments - 1);
      for (int k = hi + 1; k <= to; ++k) look_at(k);
      hi = to;
    }
    return (best_ + best_t_) / state_.segments;
  }

 private:
  void look_at(int k) {
    const glm::dvec3 a = state_.node_m[first_ + std::size_t(k)],
                     b = state_.node_m[first_ + std::size_t(k) + 1];
    const glm::dvec3 along = b - a;
    const double length2 = glm::dot(along, along);
    const double t = length2 > 0 ? std::clamp(glm::dot(p_ - a, along) / length2, 0.0, 1.0) : 0.0;
    const glm::dvec3 gap = p_ - (a + along * t);
    const double d2 = glm::dot(gap, gap);
    if (best_ >= 0 && d2 >= best_d2_) return;
    best_ = k, best_t_ = t, best_d2_ = d2;
  }

  const BladeState& state_;
  std::size_t first_;
  glm::dvec3 p_;
  int best_ = -1;
  double best_t_ = 0, best_d2_ = 0;
};

/// now / initial of a quantity that shrinks, per node; the pointed tip (0 / 0) takes its neighbour's ratio.
std::vector<double> ratios(const std::vector<float>& now, const std::vector<float>& initial) {
  std::vector<double> ratio(now.size(), 1.0);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (initial[i] > 0)
      ratio[i] = double(now[i]) / initial[i];
    else if (i > 0)
      ratio[i] = ratio[i - 1];
  }
  return ratio;
}

/// Everything that riding needs, the same for all points.
struct Ride {
  const BladeState& now;
  std::vector<double> width_ratio, thickness_ratio;
  int first_blade_id;

  void move(PointSet& points, std::size_t i) const {
    const Spot spot = spot_at(now, points.blade_id[i] - first_blade_id, points.arc[i]);
    const Frame frame = frame_at(now, spot);
    glm::dvec3 offset(points.offset[i]);
    offset.x *= between(width_ratio, spot);
    offset.y *= between(thickness_ratio, spot);
    glm::dvec3 p = between(now.node_m, spot) + frame.to_world(offset);
    p.z = std::max(p.z, 0.0);
    points.position_m[i] = p;
    points.velocity_m_s[i] = glm::vec3(between(now.velocity_m_day, spot) / kSecondsPerDay);
    points.tangent[i] = glm::vec3(frame.tangent);
    points.normal[i] = glm::vec3(frame.to_world(glm::dvec3(points.normal_local[i])));
    age(points, i, spot);
  }

  void age(PointSet& points, std::size_t i, Spot spot) const {
    points.water[i] = between(now.water, spot);
    points.chlorophyll_ug_cm2[i] = between(now.chlorophyll, spot) * float(now.chlorophyll_fresh_ug_cm2);
    points.stress_vein_MPa[i] = between(now.stress_vein_MPa, spot);
    points.stress_mesophyll_MPa[i] = between(now.stress_mesophyll_MPa, spot);
    points.strain_shrink[i] = between(points.tissue[i] == 1 ? now.strain_vein : now.strain_mesophyll, spot);
    points.specular[i] = between(now.specular, spot);
    points.diffuse[i] = between(now.diffuse, spot);
  }
};

}  // namespace

void attach_to_blades(PointSet& points, const BladeState& state, int first_blade_id, double tile_m) {
  check("attach_to_blades", points, state, first_blade_id);
  parallel_for(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const int blade = points.blade_id[i] - first_blade_id;
      const Spot inherited = spot_at(state, blade, points.arc[i]);
      glm::dvec3& p = points.position_m[i];
      if (tile_m > 0)
        for (int axis : {0, 1})
          p[axis] += tile_m * std::round((between(state.node_m, inherited)[axis] - p[axis]) / tile_m);
      const std::size_t first_node = std::size_t(blade) * std::size_t(state.nodes_per_blade());
      points.arc[i] =
          static_cast<float>(NearestSegment(state, blade, p).arc_near(int(inherited.node - first_node)));
      // From the arc as stored, so that riding finds the same spot and the offset makes up for the rounding.
      const Spot spot = spot_at(state, blade, points.arc[i]);
      const Frame frame = frame_at(state, spot);
      points.offset[i] = glm::vec3(frame.to_local(p - between(state.node_m, spot)));
      points.normal_local[i] = glm::vec3(frame.to_local(glm::dvec3(points.normal[i])));
    }
  });
}

void ride_on_blades(PointSet& points, const BladeState& initial, const BladeState& now, int first_blade_id) {
  check("ride_on_blades", points, now, first_blade_id);
  if (initial.segments != now.segments || initial.half_width_m.size() != now.half_width_m.size() ||
      initial.thickness_m.size() != now.thickness_m.size())
    throw InvalidInput("ride_on_blades: the two states differ: " + std::to_string(initial.blade_count()) +
                       " and " + std::to_string(now.blade_count()) + " blades of " +
                       std::to_string(initial.segments) + " and " + std::to_string(now.segments) +
                       " segments");
  const Ride ride{now, ratios(now.half_width_m, initial.half_width_m),
                  ratios(now.thickness_m, initial.thickness_m), first_blade_id};
  parallel_for(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ride.move(points, i);
  });
}

}  // namespace witherfield::grass
