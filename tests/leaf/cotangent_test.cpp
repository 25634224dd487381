#include "sim/leaf/cotangent.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "sim/core/errors.hpp"
#include "sim/leaf/leaf_area.hpp"
#include "tests/leaf/shapes.hpp"

namespace witherfield::leaf {
namespace {

std::vector<double> applied(const SparseMatrix& l, const std::vector<double>& v) {
  std::vector<double> out(v.size());
  multiply(l, v, out);
  return out;
}

double quadratic_form(const SparseMatrix& l, const std::vector<double>& v) {
  const auto lv = applied(l, v);
  return std::inner_product(v.begin(), v.end(), lv.begin(), 0.0);
}

TEST(Cotangent, ConstantsAreItsNullSpace) {
  for (const Surface& s : {test::sheet(9), test::crumpled_plane(12)}) {
    const SparseMatrix l = cotangent_laplacian(s);
    for (const double v : applied(l, std::vector<double>(s.position_m.size(), 3.0))) EXPECT_NEAR(v, 0, 1e-12);
    // Rank n - 1: it becomes regular as soon as one value is held.
    std::vector<double> d(s.position_m.size(), 0.0);
    d[3] = 1;
    EXPECT_NO_THROW(SparseCholesky(scaled_plus_diagonal(l, 1, d)));
  }
}

TEST(Cotangent, IsSymmetricWithNegativeWeightsOffTheDiagonal) {
  const Surface s = test::crumpled_plane(12);
  const SparseMatrix l = cotangent_laplacian(s);
  for (int i = 0; i < l.rows(); ++i)
    for (int k = l.row_start[std::size_t(i)]; k < l.row_start[std::size_t(i) + 1]; ++k) {
      const int at = l.find(l.column[std::size_t(k)], i);
      ASSERT_GE(at, 0);
      EXPECT_DOUBLE_EQ(l.value[std::size_t(k)], l.value[std::size_t(at)]);
    }
  // Right angles and 45 degrees: w = cot 45 + cot 45 inside along the axes, 0 along the diagonals, cot 45 on the border.
  const SparseMatrix grid = cotangent_laplacian(test::sheet(5, 0));
  EXPECT_NEAR(grid.value[std::size_t(grid.find(12, 13))], -2, 1e-12);
  EXPECT_NEAR(grid.value[std::size_t(grid.find(6, 12))], 0, 1e-12);
  EXPECT_NEAR(grid.value[std::size_t(grid.find(0, 1))], -1, 1e-12);
  EXPECT_NEAR(grid.value[std::size_t(grid.find(12, 12))], 8, 1e-12);
}

TEST(Cotangent, EnergyOfALinearFunctionIsItsGradientSquaredTimesTheArea) {
  const Surface s = test::crumpled_plane(15);
  std::vector<double> f;
  for (const glm::dvec3& p : s.position_m) f.push_back(2 * p.x - 3 * p.y + 5);
  EXPECT_NEAR(0.5 * quadratic_form(cotangent_laplacian(s), f), 13 * surface_area_m2(s), 1e-9);
  // Twice the conductance, twice the energy.
  EXPECT_NEAR(0.5 * quadratic_form(cotangent_laplacian(s.position_m, s.triangles, std::vector<double>(s.triangles.size(), 2.0)), f),
              26 * surface_area_m2(s), 1e-9);
}

TEST(Cotangent, LinearPrecisionOnAPlane) {
  const int n = 15;
  const Surface s = test::crumpled_plane(n);
  const SparseMatrix l = cotangent_laplacian(s);
  std::vector<double> f;
  for (const glm::dvec3& p : s.position_m) f.push_back(2 * p.x - 3 * p.y + 5);
  const auto lf = applied(l, f);
  for (int j = 1; j + 1 < n; ++j)
    for (int i = 1; i + 1 < n; ++i) EXPECT_NEAR(lf[std::size_t(j * n + i)], 0, 1e-11);
}

TEST(Cotangent, GivesTheMeanCurvatureOfACylinder) {
  // (L v)_i / (2 A_i) = -laplace v = 2 H n = n / R outwards.
  const int n = 81;
  const double radius = 0.7;
  Surface s = test::sheet(n, 0);
  for (glm::dvec3& p : s.position_m) p = {radius * std::sin(p.x / radius), p.y, radius * std::cos(p.x / radius)};
  const SparseMatrix l = cotangent_laplacian(s);
  const auto area = vertex_areas(s.position_m, s.triangles);
  std::vector<double> x, z;
  for (const glm::dvec3& p : s.position_m) x.push_back(p.x), z.push_back(p.z);
  const std::size_t i = std::size_t(40 * n + 25);
  const glm::dvec3 curvature(applied(l, x)[i] / (2 * area[i]), 0, applied(l, z)[i] / (2 * area[i]));
  const glm::dvec3 outwards(s.position_m[i].x / radius, 0, s.position_m[i].z / radius);
  EXPECT_NEAR(glm::dot(curvature, outwards), 1 / radius, 2e-3);
}

TEST(Cotangent, WeightsOfSliversAreFiniteAndKeepItSemiDefinite) {
  Surface s = test::sheet(6, 0);
  const std::size_t v = 2 * 6 + 2;
  for (const double gap : {1e-3, 1e-7, 1e-12, 1e-300, 0.0}) {
    s.position_m[v] = s.position_m[v + 1] - glm::dvec3(gap, 0, 0);  // needles and caps around it
    const auto all = corner_cotangents(s.position_m, s.triangles);
    for (const auto& cots : all)
      for (const double c : cots) ASSERT_TRUE(std::isfinite(c)) << gap;
    const SparseMatrix l = cotangent_laplacian(s);
    // v^T L v >= 0 for any v: the matrix stays factorable when a little is added.
    std::vector<double> d(s.position_m.size(), 1e-6);
    EXPECT_NO_THROW(SparseCholesky(scaled_plus_diagonal(l, 1, d))) << gap;
  }
  // All corners in one place.
  const std::vector<glm::dvec3> same(3, glm::dvec3(1, 2, 3));
  const std::vector<std::array<int, 3>> one{{0, 1, 2}};
  const auto cots = corner_cotangents(same, one);
  for (const double c : cots[0]) EXPECT_EQ(c, 0);
}

TEST(Cotangent, MassSumsToTheArea) {
  const Surface s = test::sheet(20);
  const auto area = vertex_areas(s.position_m, s.triangles);
  EXPECT_NEAR(std::accumulate(area.begin(), area.end(), 0.0), surface_area_m2(s), 1e-12);
}

TEST(Cotangent, PiecesAreNumberedByTheirSmallestVertex) {
  const std::vector<std::array<int, 3>> triangles{{4, 5, 6}, {0, 2, 3}, {6, 5, 7}};
  std::vector<int> piece;
  EXPECT_EQ(connected_pieces(8, triangles, piece), 3);  // vertex 1 is alone
  EXPECT_EQ(piece, (std::vector<int>{0, 1, 0, 0, 2, 2, 2, 2}));
}

TEST(SparseCholesky, SolvesInterleavedRightHandSides) {
  const Surface s = test::sheet(13);
  const std::size_t n = s.position_m.size();
  std::vector<double> d(n, 0.3);
  const SparseMatrix a = scaled_plus_diagonal(cotangent_laplacian(s), 1, d);
  for (const Factor kind : {Factor::sparse, Factor::blocked}) {
    const SparseCholesky factor(a, kind);
    for (const int width : {1, 2, 3, 4}) {
      Random random(3, Stream::test, std::uint64_t(width));
      std::vector<double> x(n * std::size_t(width)), b(x.size()), found(x.size());
      for (double& v : x) v = random.uniform(-1, 1);
      multiply(a, x, b, width);
      factor.solve(b, found, width);
      for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(found[i], x[i], 1e-12);
      factor.solve(b, b, width);
      EXPECT_EQ(b, found);  // in place
    }
  }
}

TEST(SparseCholesky, RefactorsOnTheSamePatternAndCounts) {
  const Surface s = test::sheet(5);
  const std::vector<double> d(s.position_m.size(), 1.0);
  SparseMatrix a = scaled_plus_diagonal(cotangent_laplacian(s), 1, d);
  SparseCholesky factor(a);
  for (double& v : a.value) v *= 4;
  factor.refactor(a);
  EXPECT_EQ(factor.factorisations(), 2);
  std::vector<double> b(d), x(d.size());
  factor.solve(b, x);
  for (const double v : x) EXPECT_NEAR(v, 0.25, 1e-12);  // (4 (L + 1)) x = 1
  EXPECT_THROW(factor.refactor(cotangent_laplacian(test::sheet(6))), InvalidInput);
}

TEST(SparseCholesky, SaysThatAMatrixIsNotPositiveDefinite) {
  const Surface s = test::sheet(5);
  std::vector<double> d(s.position_m.size(), 1.0);
  d[7] = -100;
  try {
    SparseCholesky bad(scaled_plus_diagonal(cotangent_laplacian(s), 1, d));
    FAIL();
  } catch (const SolverFailure& e) {
    EXPECT_NE(std::string(e.what()).find("not positive definite"), std::string::npos);
  }
}

}  // namespace
}  // namespace witherfield::leaf
