// Laws of a closed shell, checked without any library.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "sim/fruit/organ.hpp"

namespace witherfield::fruit {

/// Every directed edge once, with its opposite: closed, manifold along edges, faces turned alike. Euler
/// number 2: a ball.
inline void expect_ball(const Surface& s, const std::string& name) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : s.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1) << name << ": edge " << edge.first << "-" << edge.second
                        << " has two faces on one side";
    ASSERT_TRUE(edges.count({edge.second, edge.first}))
        << name << ": border at " << edge.first << "-" << edge.second;
  }
  EXPECT_EQ(int(s.position_m.size()) - int(edges.size()) / 2 + int(s.triangles.size()), 2) << name;
  EXPECT_GT(enclosed_volume_m3(s, 0, s.triangles.size()), 0) << name << " is inside out";
}

struct Box {
  glm::dvec3 lo{1e300}, hi{-1e300};
  glm::dvec3 size() const { return hi - lo; }
};
inline Box box_of(const Surface& s) {
  Box b;
  for (const glm::dvec3& p : s.position_m)
    for (int k = 0; k < 3; ++k) {
      b.lo[k] = std::min(b.lo[k], p[k]);
      b.hi[k] = std::max(b.hi[k], p[k]);
    }
  return b;
}

}  // namespace witherfield::fruit
