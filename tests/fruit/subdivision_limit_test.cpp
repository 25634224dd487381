// Limits: closed forms, consistency between levels, and that refinement indeed goes there.
#include <gtest/gtest.h>

#include "tests/fruit/mesh_fixtures.hpp"

namespace witherfield::fruit {
namespace {

using namespace fixtures;

struct LimitPoints {
  Points position, normal;
};

LimitPoints limit(const Refinement& r, const Points& control) {
  LimitPoints out{Points(r.vertices()), Points(r.vertices())};
  r.evaluate_limit(control, out.position, out.normal);
  return out;
}

double volume(const Refinement& r, const Points& p) {
  double sum = 0;
  for (const auto& t : r.triangles())
    sum += glm::dot(p[std::size_t(t[0])], glm::cross(p[std::size_t(t[1])], p[std::size_t(t[2])])) / 6;
  return sum;
}

double area(const Refinement& r, const Points& p) {
  double sum = 0;
  for (const auto& t : r.triangles())
    sum += glm::length(glm::cross(p[std::size_t(t[1])] - p[std::size_t(t[0])],
                                  p[std::size_t(t[2])] - p[std::size_t(t[0])])) /
           2;
  return sum;
}

struct Platonic {
  ControlMesh mesh;
  double vertex, edge, edge_limit, volume, area;
};

TEST(Limit, PlatonicBodies) {
  for (const Platonic& b :
       {Platonic{tetrahedron(), .2, .288675135, .168393829, .019821, .362457},
        Platonic{octahedron(), 24.0 / 55, .530330086, .414320380, .303855, 2.191148},
        Platonic{icosahedron(), .707809117, .769420884, .701024598, 1.450426, 6.197605}}) {
    for (const Scheme scheme : {Scheme::liu2007, Scheme::hoppe1994}) {
      const Refinement r(b.mesh, scheme, 1);
      const Points p = evaluated(r, b.mesh.position_m);
      const LimitPoints l = limit(r, b.mesh.position_m);
      for (std::size_t v = 0; v < r.vertices(); ++v) {
        const bool old = v < b.mesh.position_m.size();
        EXPECT_NEAR(glm::length(l.position[v]), old ? b.vertex : b.edge_limit, 1e-9);
        if (!old) {
          EXPECT_NEAR(glm::length(p[v]), b.edge, 1e-9);
        }
        // By symmetry the normals are radial.
        EXPECT_LT(glm::length(l.normal[v] - glm::normalize(l.position[v])), 1e-12);
      }
    }
    // Volumes of inscribed meshes grow with h^2: two levels and Richardson.
    const Refinement five(b.mesh, Scheme::hoppe1994, 5), six(b.mesh, Scheme::hoppe1994, 6);
    const Points p5 = limit(five, b.mesh.position_m).position, p6 = limit(six, b.mesh.position_m).position;
    EXPECT_NEAR((4 * volume(six, p6) - volume(five, p5)) / 3, b.volume, 2e-6);
    EXPECT_NEAR((4 * area(six, p6) - area(five, p5)) / 3, b.area, 2e-6 * 6);
  }
}

TEST(Limit, VolumesAndAreasOfTheFirstSteps) {
  const double octa[] = {1.3333333333, .430664062, .331721395, .310606806};
  const double octa_area[] = {2.884398882, 2.346745882, 2.228985979};
  const double icosa[] = {2.5361507, 1.663679837, 1.500957579, 1.462898705};
  for (int steps = 0; steps <= 3; ++steps) {
    const ControlMesh o = octahedron(), i = icosahedron();
    const Refinement ro(o, Scheme::hoppe1994, steps), ri(i, Scheme::liu2007, steps);
    EXPECT_NEAR(volume(ro, evaluated(ro, o.position_m)), octa[steps], 1e-9);
    EXPECT_NEAR(area(ro, evaluated(ro, o.position_m)), steps == 0 ? 4 * std::sqrt(3.0) : octa_area[steps - 1],
                2e-9);
    EXPECT_NEAR(volume(ri, evaluated(ri, i.position_m)), icosa[steps], 1e-7);
  }
}

TEST(Limit, WeightsByValence) {
  const std::map<int, std::array<double, 2>> smooth = {{3, {.4, .2}},
                                                       {4, {.4363636364, .1409090909}},
                                                       {5, {.4714217269, .1057156546}},
                                                       {6, {.5, .0833333333}},
                                                       {7, {.5221572621, .0682632483}},
                                                       {8, {.5391475166, .0576065604}},
                                                       {12, {.5768163776, .0352653019}}};
  for (const auto& [n, weight] : smooth) {
    ControlMesh m = bipyramid(n);
    for (const bool sharp : {false, true}) {
      if (sharp) m.sharp_vertices = {0};
      const Refinement r(m, Scheme::liu2007, 0);
      const double omega = 3 * std::pow(2, n - 1) / 8;
      const double own = sharp ? omega / (omega + n) : weight[0], ring = sharp ? 1 / (omega + n) : weight[1];
      for (int moved = 0; moved < n + 2; ++moved) {
        Points control(m.position_m.size(), glm::dvec3(0));
        control[std::size_t(moved)].x = 1;
        EXPECT_NEAR(limit(r, control).position[0].x, moved == 0 ? own : moved == 1 ? 0 : ring, 1e-10) << n;
      }
    }
  }
}

/// Height that the limit keeps of an apex of height 1: the sharp rule flattens valence 4, and points from 8
/// on.
TEST(Limit, ApexUnderTheSharpRule) {
  for (const auto& [n, height] :
       {std::pair{4, .428571429}, {5, .545454545}, {6, .666666667}, {8, .857142857}}) {
    ControlMesh m = bipyramid(n);
    const double loop = limit(Refinement(m, Scheme::liu2007, 0), m.position_m).position[0].z;
    m.sharp_vertices = {0};
    const double sharp = limit(Refinement(m, Scheme::liu2007, 0), m.position_m).position[0].z;
    EXPECT_NEAR(sharp, height, 1e-9);
    EXPECT_EQ(sharp > loop, n > 4);
    EXPECT_EQ(limit(Refinement(m, Scheme::hoppe1994, 0), m.position_m).position[0].z, 1);
  }
}

/// Weights of the limit along a crease of a regular sheet, at its middle vertex.
TEST(Limit, CreaseOfEachScheme) {
  const auto weights = [](Scheme scheme, ControlMesh m, int steps, int centre, int left, int right) {
    const Refinement r(m, scheme, steps);
    std::array<double, 3> w;
    std::size_t i = 0;
    for (const int moved : {left, centre, right}) {
      Points control(m.position_m.size(), glm::dvec3(0));
      control[std::size_t(moved)].x = 1;
      w[i++] = limit(r, control).position[std::size_t(centre)].x;
    }
    return w;
  };
  ControlMesh m = sheet(6);
  m.crease_edges = {{22, 23}, {23, 24}, {24, 25}, {25, 26}};
  for (const int steps : {0, 2}) {
    auto w = weights(Scheme::hoppe1994, m, steps, 24, 23, 25);
    EXPECT_NEAR(w[0], 1.0 / 6, 1e-14);
    EXPECT_NEAR(w[1], 2.0 / 3, 1e-14);
    EXPECT_NEAR(w[2], 1.0 / 6, 1e-14);
    w = weights(Scheme::liu2007, m, steps, 24, 23, 25);
    EXPECT_NEAR(w[0], 0.1, 1e-14);
    EXPECT_NEAR(w[1], 0.8, 1e-14);
    w = weights(Scheme::liu2007, sheet(6), steps, 3, 2, 4);  // a border, in either scheme
    EXPECT_NEAR(w[1], 2.0 / 3, 1e-14);
    w = weights(Scheme::hoppe1994, sheet(6), steps, 3, 2, 4);
    EXPECT_NEAR(w[0], 1.0 / 6, 1e-14);
  }
  // Not regular: one smooth edge on one side, three on the other. Its neighbours along the crease are.
  ControlMesh bent = sheet(6);
  bent.crease_edges = {{22, 23}, {23, 24}, {24, 32}, {32, 40}};
  auto w = weights(Scheme::hoppe1994, bent, 0, 24, 23, 32);
  EXPECT_NEAR(w[0], 1.0 / 5, 1e-14);
  EXPECT_NEAR(w[1], 3.0 / 5, 1e-14);
  EXPECT_NEAR(w[2], 1.0 / 5, 1e-14);
  // 32 not regular either: 1/2, 1/2 between the two in the first step, 5/8, 3/8 from then on.
  bent.crease_edges.back() = {32, 33};
  w = weights(Scheme::hoppe1994, bent, 0, 24, 23, 32);
  EXPECT_NEAR(w[1], 3.0 / 5 * 3 / 4 + 1.0 / 5 * (3.0 / 8 + 1.0 / 2), 1e-14);
}

/// The limit of a vertex is the same from whatever level it is asked.
TEST(Limit, IsTheSameFromEveryLevel) {
  for (const Scheme scheme : {Scheme::liu2007, Scheme::hoppe1994})
    for (ControlMesh m : {torus(8, 6, 20), sheet(5)}) {
      jiggle(m, 0.1);
      tag(m, 8);
      if (scheme == Scheme::liu2007)
        std::erase_if(m.sharp_vertices, [](int v) { return v % 5 == 0; });  // corners
      LimitPoints before = limit(Refinement(m, scheme, 0), m.position_m);
      for (int steps = 1; steps <= 4; ++steps) {
        const Refinement r(m, scheme, steps);
        const LimitPoints now = limit(r, m.position_m);
        for (std::size_t v = 0; v < before.position.size(); ++v) {
          EXPECT_LT(glm::length(now.position[v] - before.position[v]), 1e-12) << steps << ' ' << v;
          if (r.rules()[v] == VertexRule::smooth) {
            EXPECT_LT(glm::length(now.normal[v] - before.normal[v]), 1e-9) << steps << ' ' << v;
          }
        }
        before = now;
      }
    }
}

/// Four steps more bring a mesh 2^4 or more closer to its own limit: an error in a mask of either would not
/// vanish.
TEST(Limit, RefinementConvergesToIt) {
  for (const Scheme scheme : {Scheme::liu2007, Scheme::hoppe1994}) {
    ControlMesh m = torus(6, 5, 8);
    tag(m, 6);
    const auto gap = [&](int steps) {
      const Refinement r(m, scheme, steps);
      const Points p = evaluated(r, m.position_m), l = limit(r, m.position_m).position;
      double worst = 0;
      for (std::size_t v = 0; v < m.position_m.size(); ++v) worst = std::max(worst, glm::length(p[v] - l[v]));
      return worst;
    };
    EXPECT_LT(gap(7), gap(3) / 8);
    EXPECT_GT(gap(3), 1e-6);
  }
}

/// Normals against the faces of a much finer mesh.
TEST(Limit, NormalsStandOnTheSurface) {
  for (const Scheme scheme : {Scheme::liu2007, Scheme::hoppe1994})
    for (ControlMesh m : {torus(8, 6, 20), sheet(4), bipyramid(7)}) {
      jiggle(m, 0.15);
      if (m.position_m.size() == 9)
        m.sharp_vertices = {0};  // valence 7: pointed, but still a tangent plane in liu2007
      const Refinement coarse(m, scheme, 1), fine(m, scheme, 7);
      const LimitPoints l = limit(coarse, m.position_m), f = limit(fine, m.position_m);
      Points mean(fine.vertices(), glm::dvec3(0));
      for (const auto& t : fine.triangles()) {
        const auto at = [&](int i) { return f.position[std::size_t(t[std::size_t(i)])]; };
        const glm::dvec3 n = glm::cross(at(1) - at(0), at(2) - at(0));
        for (const int v : t) mean[std::size_t(v)] += n;
      }
      for (std::size_t v = 0; v < coarse.vertices(); ++v) {
        EXPECT_NEAR(glm::length(l.normal[v]), 1, 1e-12);
        EXPECT_GT(glm::dot(l.normal[v], glm::normalize(mean[v])), 0.998)
            << v << " of " << m.position_m.size();
      }
    }
}

/// Vertex 0 on the border of a fan of k faces.
ControlMesh fan(int k) {
  ControlMesh m;
  m.position_m.emplace_back(0, 0, 0);
  for (int i = 0; i <= k; ++i) {
    const double a = std::numbers::pi * std::min(1.0 / 3, 1.0 / k) * i;  // one face: 60 degrees
    m.position_m.emplace_back(std::cos(a), std::sin(a), 0);
    if (i > 0) m.triangles.push_back({0, i, i + 1});
  }
  jiggle(m, 0.3);
  return m;
}

/// On a border of any valence the tangent plane has one of its own, whatever level it is asked from.
TEST(Limit, NormalOnTheBorder) {
  for (const Scheme scheme : {Scheme::liu2007, Scheme::hoppe1994})
    for (int k = 1; k <= 8; ++k) {
      if (k == 2 && scheme == Scheme::hoppe1994)
        continue;  // two eigenvalues fall together: mean of the faces
      const ControlMesh m = fan(k);
      const glm::dvec3 first = limit(Refinement(m, scheme, 0), m.position_m).normal[0];
      EXPECT_GT(first.z, 0.5) << k << " faces";
      for (int steps = 1; steps <= 4; ++steps)
        EXPECT_LT(glm::length(limit(Refinement(m, scheme, steps), m.position_m).normal[0] - first), 1e-9)
            << k << " faces, step " << steps;
      const Refinement fine(m, scheme, 8);
      const LimitPoints f = limit(fine, m.position_m);
      glm::dvec3 mean(0);
      for (const auto& t : fine.triangles())
        if (t[0] == 0)
          mean += glm::cross(f.position[std::size_t(t[1])] - f.position[0],
                             f.position[std::size_t(t[2])] - f.position[0]);
      EXPECT_GT(glm::dot(glm::normalize(mean), first), 0.998) << k << " faces";
    }
}

TEST(Limit, CuspTakesTheMeanOfItsFaces) {
  ControlMesh m = bipyramid(8);
  jiggle(m, 0.3);
  m.sharp_vertices = {0};
  const Refinement r(m, Scheme::liu2007, 2);
  const LimitPoints l = limit(r, m.position_m);
  glm::dvec3 mean(0);
  for (const auto& t : r.triangles())
    if (t[0] == 0)
      mean += glm::cross(l.position[std::size_t(t[1])] - l.position[0],
                         l.position[std::size_t(t[2])] - l.position[0]);
  EXPECT_LT(glm::length(l.normal[0] - glm::normalize(mean)), 1e-12);
  m.position_m.emplace_back(5, 5, 5);
  EXPECT_EQ(limit(Refinement(m, Scheme::liu2007, 2), m.position_m).normal[10],
            glm::dvec3(0));  // a stray has no faces
}

TEST(Limit, RegularFlatSheetDoesNotMove) {
  const ControlMesh m = sheet(8);
  const LimitPoints l = limit(Refinement(m, Scheme::hoppe1994, 0), m.position_m);
  for (int y = 1; y < 8; ++y)
    for (int x = 1; x < 8; ++x) {
      const auto v = std::size_t(9 * y + x);
      EXPECT_LT(glm::length(l.position[v] - m.position_m[v]), 1e-15);
    }
  for (const auto& n : l.normal) EXPECT_LT(glm::length(n - glm::dvec3(0, 0, 1)), 1e-12);
}

}  // namespace
}  // namespace witherfield::fruit
