#include "sim/check/surface_check.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

#include "sim/check/topology.hpp"
#include "sim/core/parallel.hpp"

namespace witherfield::check {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Pair = std::pair<int, int>;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

/// Exact answers about the faces of one surface.
class Faces {
 public:
  Faces(const Surface& surface, const std::vector<int>& first_equal)
      : surface_(surface), first_equal_(first_equal) {}

  bool degenerate(int face) const { return CGAL::collinear(point(face, 0), point(face, 1), point(face, 2)); }

  Box box(int face) const {
    CGAL::Bbox_3 b = point(face, 0).bbox();
    for (int k = 1; k < 3; ++k) b += point(face, k).bbox();
    return {b, face};
  }

  /// @pre neither is degenerate.
  bool intersect(int f, int g) const {
    // Corner k of f is corner match[k] of g; -1: not one of its corners.
    std::array<int, 3> match{-1, -1, -1};
    int shared = 0;
    for (int k = 0; k < 3; ++k)
      for (int m = 0; m < 3; ++m)
        if (corner(f, k) == corner(g, m)) {
          match[std::size_t(k)] = m;
          ++shared;
        }
    if (shared == 0) return CGAL::do_intersect(triangle(f), triangle(g));
    if (shared == 3) return false;  // counted as duplicates
    if (shared == 1) {
      const int k =
          int(std::find_if(match.begin(), match.end(), [](int m) { return m >= 0; }) - match.begin());
      return CGAL::do_intersect(triangle(f), opposite(g, match[std::size_t(k)])) ||
             CGAL::do_intersect(triangle(g), opposite(f, k));
    }
    // A common edge: they overlap only if one is folded flat onto the other.
    const int apex = int(std::find(match.begin(), match.end(), -1) - match.begin());
    const int other = 3 - match[std::size_t((apex + 1) % 3)] - match[std::size_t((apex + 2) % 3)];
    const Point p = point(f, (apex + 1) % 3), q = point(f, (apex + 2) % 3), r = point(f, apex),
                s = point(g, other);
    return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
  }

 private:
  int corner(int face, int k) const {
    return first_equal_[std::size_t(surface_.triangles[std::size_t(face)][std::size_t(k)])];
  }
  Point point(int face, int k) const {
    const glm::dvec3& p =
        surface_.position_m[std::size_t(surface_.triangles[std::size_t(face)][std::size_t(k)])];
    return {p.x, p.y, p.z};
  }
  Kernel::Triangle_3 triangle(int face) const { return {point(face, 0), point(face, 1), point(face, 2)}; }
  Kernel::Segment_3 opposite(int face, int k) const {
    return {point(face, (k + 1) % 3), point(face, (k + 2) % 3)};
  }

  const Surface& surface_;
  const std::vector<int>& first_equal_;
};

std::vector<char> degenerate_faces(const Faces& faces, std::size_t count) {
  std::vector<char> flags(count);
  parallel_for(count, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) flags[f] = faces.degenerate(int(f));
  });
  return flags;
}

/// Takes candidates one by one, tests them in parallel batch by batch, keeps the count and the first ids.
class Candidates {
 public:
  Candidates(const Faces& faces, const std::vector<int>& component, std::size_t listed, MeshReport& report)
      : faces_(faces), component_(component), listed_(listed), report_(report) {
    batch_.reserve(kBatch);
  }
  void add(int f, int g) {
    batch_.push_back(std::minmax(f, g));
    if (batch_.size() == kBatch) test();
  }
  void finish() {
    test();
    shorten();
  }

 private:
  static constexpr std::size_t kBatch = 1 << 20;

  void test() {
    hit_.assign(batch_.size(), 0);
    parallel_for(batch_.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) hit_[i] = faces_.intersect(batch_[i].first, batch_[i].second);
    });
    for (std::size_t i = 0; i < batch_.size(); ++i) {
      if (!hit_[i]) continue;
      const auto [f, g] = batch_[i];
      const bool one_shell = component_[std::size_t(f)] == component_[std::size_t(g)];
      ++(one_shell ? report_.self_intersections : report_.shell_intersections);
      (one_shell ? report_.self_intersection_ids : report_.shell_intersection_ids).push_back(batch_[i]);
    }
    batch_.clear();
    // A mesh may intersect itself n^2 times.
    if (report_.self_intersection_ids.size() + report_.shell_intersection_ids.size() > kBatch) shorten();
  }
  void shorten() {
    for (auto* ids : {&report_.self_intersection_ids, &report_.shell_intersection_ids}) {
      std::sort(ids->begin(), ids->end());
      ids->resize(std::min(ids->size(), listed_));
    }
  }

  const Faces& faces_;
  const std::vector<int>& component_;
  const std::size_t listed_;
  MeshReport& report_;
  std::vector<Pair> batch_;
  std::vector<char> hit_;
};

void find_self_intersections(const Faces& faces, const std::vector<char>& degenerate,
                             const std::vector<int>& component, std::size_t listed, MeshReport& report) {
  std::vector<Box> boxes;
  boxes.reserve(degenerate.size());
  for (std::size_t f = 0; f < degenerate.size(); ++f)
    if (!degenerate[f]) boxes.push_back(faces.box(int(f)));  // a face without area has no plane to intersect
  std::vector<const Box*> pointers;
  pointers.reserve(boxes.size());
  for (const Box& b : boxes) pointers.push_back(&b);
  Candidates candidates(faces, component, listed, report);
  CGAL::box_self_intersection_d(pointers.begin(), pointers.end(),
                                [&](const Box* a, const Box* b) { candidates.add(a->info(), b->info()); });
  candidates.finish();
  report.self_intersections_checked = true;
}

}  // namespace

MeshReport check_surface(const Surface& surface, const MeshCheckOptions& options) {
  MeshReport report;
  const Topology topology = analyse_topology(surface, options.listed, report);
  if (report.faces == 0 || report.non_finite_vertices > 0) return report;
  report.geometry_checked = true;
  measure_components(surface, topology.component, report);
  const Faces faces(surface, topology.first_equal);
  const std::vector<char> degenerate = degenerate_faces(faces, report.faces);
  for (std::size_t f = 0; f < report.faces; ++f)
    if (degenerate[f] && ++report.degenerate_faces <= options.listed) report.degenerate_ids.push_back(int(f));
  if (options.self_intersections)
    find_self_intersections(faces, degenerate, topology.component, options.listed, report);
  return report;
}

}  // namespace witherfield::check
