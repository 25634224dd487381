#include "sim/leaf/segment_grid.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/leaf/splines.hpp"

namespace witherfield::leaf {

void SegmentGrid::add(const glm::dvec2& a, const glm::dvec2& b, int tag, double start, double end) {
  segments_.push_back({a, b, tag, start, end});
}

void SegmentGrid::add_line(std::span<const glm::dvec2> line, int tag) {
  const double length = std::max(polyline_length(line), 1e-300);
  double passed = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double next = passed + glm::distance(line[i], line[i + 1]);
    add(line[i], line[i + 1], tag, passed / length, next / length);
    passed = next;
  }
}

void SegmentGrid::build() {
  if (segments_.empty()) return;
  glm::dvec2 high = segments_[0].a;
  low_ = high;
  for (const Segment& s : segments_) {
    low_ = glm::min(low_, glm::min(s.a, s.b));
    high = glm::max(high, glm::max(s.a, s.b));
  }
  low_ -= 1.5 * cell_m_;
  nx_ = int((high.x - low_.x) / cell_m_) + 3;
  ny_ = int((high.y - low_.y) / cell_m_) + 3;
  // Each segment stands in every bucket within a bucket's size of its box: a query reads one bucket only.
  for (const bool counting : {true, false}) {
    if (counting) start_.assign(std::size_t(nx_) * std::size_t(ny_) + 1, 0);
    for (std::size_t k = 0; k < segments_.size(); ++k) {
      const Segment& s = segments_[k];
      const glm::dvec2 from = (glm::min(s.a, s.b) - cell_m_ - low_) / cell_m_, to = (glm::max(s.a, s.b) + cell_m_ - low_) / cell_m_;
      for (int j = std::max(0, int(from.y)); j <= std::min(ny_ - 1, int(to.y)); ++j)
        for (int i = std::max(0, int(from.x)); i <= std::min(nx_ - 1, int(to.x)); ++i) {
          if (counting) ++start_[bucket(i, j) + 1];
          else item_[std::size_t(start_[bucket(i, j)]++)] = int(k);
        }
    }
    if (counting) {
      for (std::size_t b = 0; b + 1 < start_.size(); ++b) start_[b + 1] += start_[b];
      item_.resize(std::size_t(start_.back()));
    }
  }
  for (std::size_t b = start_.size() - 1; b > 0; --b) start_[b] = start_[b - 1];  // filling moved them on by one
  start_[0] = 0;
}

SegmentGrid::Hit SegmentGrid::hit(const Segment& s, const glm::dvec2& p) const {
  const glm::dvec2 ab = s.b - s.a;
  const double square = glm::dot(ab, ab);
  const double t = square > 0 ? std::clamp(glm::dot(p - s.a, ab) / square, 0.0, 1.0) : 0.0;
  return {glm::distance(p, s.a + t * ab), s.tag, s.start + t * (s.end - s.start)};
}

SegmentGrid::Hit SegmentGrid::nearest(const glm::dvec2& p, int but) const {
  Hit best;
  each(p, [&](const Hit& h) {
    if (h.tag != but && h.distance_m < best.distance_m) best = h;
  });
  if (best.distance_m > cell_m_) return {};
  return best;
}

}  // namespace witherfield::leaf
