#include "sim/check/overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include "sim/check/topology.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/core/random.hpp"

namespace witherfield::check {
namespace {

using std::size_t;

constexpr size_t kShifts = 8;

struct Extent {
  glm::dvec3 lo{std::numeric_limits<double>::infinity()}, hi{-std::numeric_limits<double>::infinity()};
  void add(const glm::dvec3& p) {
    for (int c = 0; c < 3; ++c) {
      lo[c] = std::min(lo[c], p[c]);
      hi[c] = std::max(hi[c], p[c]);
    }
  }
  Extent common(const Extent& other) const {
    Extent e;
    for (int c = 0; c < 3; ++c) {
      e.lo[c] = std::max(lo[c], other.lo[c]);
      e.hi[c] = std::min(hi[c], other.hi[c]);
    }
    return e;
  }
  bool has_volume() const { return lo.x < hi.x && lo.y < hi.y && lo.z < hi.z; }
};

struct Shell {
  size_t number = 0;
  double volume_m3 = 0;
  Extent extent;
  std::vector<int> faces;
};

struct Line {
  double x, y;
  size_t index;
};
struct Crossing {
  size_t line;
  double z;
  int sign;
};

std::vector<Shell> closed_shells(const Surface& s) {
  MeshReport report;
  const Topology topology = analyse_topology(s, 0, report);
  measure_components(s, topology.component, report);
  std::vector<Shell> shells;
  std::vector<int> place(report.component.size(), -1);
  for (size_t c = 0; c < report.component.size(); ++c) {
    const double volume = std::abs(report.component[c].volume_m3);
    if (!report.component[c].closed || !(volume > 0)) continue;
    place[c] = int(shells.size());
    shells.push_back({c, volume, {}, {}});
  }
  for (size_t f = 0; f < s.triangles.size(); ++f) {
    const int at = place[size_t(topology.component[f])];
    if (at < 0) continue;
    Shell& shell = shells[size_t(at)];
    shell.faces.push_back(int(f));
    for (const int v : s.triangles[f]) shell.extent.add(s.position_m[size_t(v)]);
  }
  return shells;
}

/// Pairs (i < j of `shells`) whose boxes have a volume in common: sweep along x.
std::vector<std::pair<size_t, size_t>> candidate_pairs(const std::vector<Shell>& shells) {
  std::vector<size_t> order(shells.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return std::pair(shells[a].extent.lo.x, a) < std::pair(shells[b].extent.lo.x, b);
  });
  std::vector<std::pair<size_t, size_t>> pairs;
  for (size_t i = 0; i < order.size(); ++i) {
    const Extent& e = shells[order[i]].extent;
    for (size_t j = i + 1; j < order.size() && shells[order[j]].extent.lo.x < e.hi.x; ++j)
      if (e.common(shells[order[j]].extent).has_volume()) pairs.push_back(std::minmax(order[i], order[j]));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Points of the rank-1 lattice with the generators of the plastic number, which spread best for any count;
/// the first `lines` / kShifts in the first shift, and so on. Ascending in x.
std::vector<Line> lines_in(const Extent& e, size_t lines, size_t a, size_t b) {
  constexpr double kPlastic = 1.3247179572447460260;
  const size_t per_shift = lines / kShifts;
  std::vector<Line> out;
  out.reserve(per_shift * kShifts);
  for (size_t s = 0; s < kShifts; ++s) {
    const auto bits =
        philox4x32({std::uint32_t(a), std::uint32_t(b), std::uint32_t(s), 0}, {0x6F766572u, 0x6C617073u});
    double u = (bits[0] + 0.5) / 4294967296.0, v = (bits[1] + 0.5) / 4294967296.0;
    for (size_t i = 0; i < per_shift; ++i) {
      out.push_back({e.lo.x + u * (e.hi.x - e.lo.x), e.lo.y + v * (e.hi.y - e.lo.y), s * per_shift + i});
      u += 1 / kPlastic;
      v += 1 / (kPlastic * kPlastic);
      u -= std::floor(u);
      v -= std::floor(v);
    }
  }
  std::sort(out.begin(), out.end(),
            [](const Line& p, const Line& q) { return std::pair(p.x, p.index) < std::pair(q.x, q.index); });
  return out;
}

/// Left of the edge, seen from above. Both faces at an edge ask with its ends in the same order and get the
/// same answer, so that a line through an edge crosses exactly one of them.
bool left_of(const Surface& s, int from, int to, const Line& line) {
  const bool swap = from > to;
  const glm::dvec3 &a = s.position_m[size_t(swap ? to : from)], &b = s.position_m[size_t(swap ? from : to)];
  const bool left = (b.x - a.x) * (line.y - a.y) - (b.y - a.y) * (line.x - a.x) >= 0;
  return left != swap;
}

/// Where the lines pass through the shell, by line and z.
std::vector<Crossing> crossings(const Surface& s, const Shell& shell, const Extent& where,
                                const std::vector<Line>& lines) {
  std::vector<Crossing> out;
  for (const int f : shell.faces) {
    const auto& t = s.triangles[size_t(f)];
    Extent e;
    for (const int v : t) e.add(s.position_m[size_t(v)]);
    if (e.hi.x < where.lo.x || e.lo.x > where.hi.x || e.hi.y < where.lo.y || e.lo.y > where.hi.y) continue;
    const glm::dvec3 &a = s.position_m[size_t(t[0])], &b = s.position_m[size_t(t[1])],
                     &c = s.position_m[size_t(t[2])];
    const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (twice == 0) continue;  // seen edge-on
    auto line =
        std::lower_bound(lines.begin(), lines.end(), e.lo.x, [](const Line& l, double x) { return l.x < x; });
    for (; line != lines.end() && line->x <= e.hi.x; ++line) {
      if (line->y < e.lo.y || line->y > e.hi.y) continue;
      const bool left = left_of(s, t[0], t[1], *line);
      if (left_of(s, t[1], t[2], *line) != left || left_of(s, t[2], t[0], *line) != left) continue;
      const double wb = ((line->x - a.x) * (c.y - a.y) - (line->y - a.y) * (c.x - a.x)) / twice;
      const double wc = ((b.x - a.x) * (line->y - a.y) - (b.y - a.y) * (line->x - a.x)) / twice;
      out.push_back({line->index, a.z + wb * (b.z - a.z) + wc * (c.z - a.z), left ? 1 : -1});
    }
  }
  std::sort(out.begin(), out.end(), [](const Crossing& p, const Crossing& q) {
    return std::tie(p.line, p.z, p.sign) < std::tie(q.line, q.z, q.sign);
  });
  return out;
}

using Range = std::pair<const Crossing*, const Crossing*>;

Range next_line(const Crossing*& at, const Crossing* end, size_t line) {
  while (at != end && at->line < line) ++at;
  const Crossing* first = at;
  while (at != end && at->line == line) ++at;
  return {first, at};
}

/// Length of what lies inside both along one line: where both winding numbers are not 0.
double common_length(Range a, Range b) {
  double length = 0, from = 0;
  int in_a = 0, in_b = 0;
  while (a.first != a.second && b.first != b.second) {
    const bool next_is_a = a.first->z <= b.first->z;
    const Crossing& next = next_is_a ? *a.first++ : *b.first++;
    if (in_a != 0 && in_b != 0) length += next.z - from;
    (next_is_a ? in_a : in_b) += next.sign;
    from = next.z;
  }
  return length;  // one of the two has ended: closed, so nothing is inside it any more
}

Overlap overlap_of(const Surface& s, const Shell& a, const Shell& b, size_t line_count) {
  const Extent where = a.extent.common(b.extent);
  const std::vector<Line> lines = lines_in(where, line_count, a.number, b.number);
  const std::vector<Crossing> of_a = crossings(s, a, where, lines), of_b = crossings(s, b, where, lines);
  std::array<double, kShifts> length{};
  const size_t per_shift = line_count / kShifts;
  const Crossing *at_a = of_a.data(), *at_b = of_b.data();
  for (size_t line = 0; line < per_shift * kShifts; ++line) {
    const Range ra = next_line(at_a, of_a.data() + of_a.size(), line);
    const Range rb = next_line(at_b, of_b.data() + of_b.size(), line);
    length[line / per_shift] += common_length(ra, rb) / double(per_shift);
  }
  double mean = 0, square = 0;
  for (const double x : length) mean += x / kShifts;
  for (const double x : length) square += (x - mean) * (x - mean);
  const double area = (where.hi.x - where.lo.x) * (where.hi.y - where.lo.y);
  Overlap out{a.number, b.number};
  const double smaller = std::min(a.volume_m3, b.volume_m3);
  out.volume_m3 = mean * area;
  out.error_m3 = std::sqrt(square / (kShifts - 1) / kShifts) * area;
  out.fraction = out.volume_m3 / smaller;
  out.error = out.error_m3 / smaller;
  return out;
}

}  // namespace

std::vector<Overlap> overlap_fractions(const Surface& surface, const OverlapOptions& options) {
  if (options.lines < 2 * kShifts || options.lines > 1000000)
    throw InvalidInput("overlap_fractions: lines = " + std::to_string(options.lines) +
                       " must be in 16..1000000");
  surface.validate();
  const std::vector<Shell> shells = closed_shells(surface);
  const auto pairs = candidate_pairs(shells);
  std::vector<Overlap> all(pairs.size());
  parallel_for(pairs.size(), 1, [&](size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p)
      all[p] = overlap_of(surface, shells[pairs[p].first], shells[pairs[p].second], options.lines);
  });
  std::erase_if(all, [](const Overlap& o) { return !(o.volume_m3 > 0); });
  return all;
}

}  // namespace witherfield::check
