// Distance to the nearest of many line segments in the plane, by a grid of buckets.
#pragma once
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace witherfield::leaf {

class SegmentGrid {
 public:
  /// @param cell_m size of a bucket; also the distance up to which queries are exact.
  explicit SegmentGrid(double cell_m) : cell_m_(cell_m) {}
  /// `tag` comes back with the nearest segment.
  void add(const glm::dvec2& a, const glm::dvec2& b, int tag, double start = 0, double end = 0);
  void add_line(std::span<const glm::dvec2> line, int tag);
  /// Call after the last add, before the first query.
  void build();

  struct Hit {
    double distance_m = 1e300;
    int tag = -1;
    double along = 0;  ///< between `start` and `end` of the segment; of a line: share of its length, 0..1
  };
  /// The nearest segment not tagged `but` within the bucket size; tag -1 when there is none.
  Hit nearest(const glm::dvec2& p, int but = -2) const;
  /// Calls visit(hit) for every segment within the bucket size.
  template <class Visit>
  void each(const glm::dvec2& p, Visit visit) const;
  std::size_t size() const { return segments_.size(); }

 private:
  struct Segment {
    glm::dvec2 a, b;
    int tag;
    double start, end;
  };
  Hit hit(const Segment& s, const glm::dvec2& p) const;
  std::size_t bucket(int i, int j) const { return std::size_t(j) * std::size_t(nx_) + std::size_t(i); }

  double cell_m_;
  glm::dvec2 low_{0, 0};
  int nx_ = 0, ny_ = 0;
  std::vector<Segment> segments_;
  std::vector<int> start_, item_;
};

template <class Visit>
void SegmentGrid::each(const glm::dvec2& p, Visit visit) const {
  if (segments_.empty()) return;
  const glm::dvec2 at = (p - low_) / cell_m_;
  if (!(at.x >= 0 && at.y >= 0 && at.x < nx_ && at.y < ny_)) return;
  const std::size_t b = bucket(int(at.x), int(at.y));
  for (int k = start_[b]; k < start_[b + 1]; ++k) visit(hit(segments_[std::size_t(item_[std::size_t(k)])], p));
}

}  // namespace witherfield::leaf
