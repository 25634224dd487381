// Deformation: laws of the linear and of the rotation-aware edit.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/leaf/arap.hpp"
#include "sim/leaf/cotangent.hpp"
#include "sim/leaf/editor.hpp"
#include "sim/leaf/laplacian_edit.hpp"
#include "sim/leaf/leaf_area.hpp"
#include "tests/leaf/shapes.hpp"

namespace witherfield::leaf {
namespace {

constexpr int kSide = 25;

EditOptions mode(EditMode m, int iterations = 100, double tolerance = 1e-10) {
  EditOptions o;
  o.mode = m;
  o.max_iterations = iterations;
  o.tolerance = tolerance;
  return o;
}

std::vector<Handle> ten(double weight = 10) {
  std::vector<Handle> handles;
  for (const int v : test::ten_handles(kSide)) handles.push_back({v, weight});
  return handles;
}

std::vector<glm::dvec3> places(const Surface& s, const std::vector<Handle>& handles) {
  std::vector<glm::dvec3> p;
  for (const Handle& h : handles) p.push_back(s.position_m[std::size_t(h.vertex)]);
  return p;
}

double largest_difference(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double d = 0;
  for (std::size_t i = 0; i < a.size(); ++i) d = std::max(d, glm::distance(a[i], b[i]));
  return d;
}

Mat3 about(const glm::dvec3& axis, double angle) {
  const glm::dvec3 u = glm::normalize(axis);
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c + u.x * u.x * (1 - c), u.x * u.y * (1 - c) - u.z * s, u.x * u.z * (1 - c) + u.y * s,
           u.y * u.x * (1 - c) + u.z * s, c + u.y * u.y * (1 - c), u.y * u.z * (1 - c) - u.x * s,
           u.z * u.x * (1 - c) - u.y * s, u.z * u.y * (1 - c) + u.x * s, c + u.z * u.z * (1 - c)}};
}

TEST(LinearEdit, IsTheMinimiserOfThePapersEnergy) {
  // Against the paper's way: stack (L; H), form the normal equations, factor them.
  const Surface s = test::sheet(kSide);
  const int n = int(s.position_m.size());
  const SparseMatrix l = cotangent_laplacian(s);
  Eigen::SparseMatrix<double> matrix(n, n);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i)
    for (int k = l.row_start[std::size_t(i)]; k < l.row_start[std::size_t(i) + 1]; ++k)
      entries.emplace_back(i, l.column[std::size_t(k)], l.value[std::size_t(k)]);
  matrix.setFromTriplets(entries.begin(), entries.end());
  for (const double weight : {0.3, 10.0, 1000.0}) {
    std::vector<Handle> handles = ten(weight);
    handles[3].weight = 0.5 * weight;  // not all alike
    auto target = places(s, handles);
    target[2] += glm::dvec3(0.1, -0.2, 0.3);
    target[7] += glm::dvec3(-0.3, 0.1, 0.5);
    Eigen::MatrixXd v(n, 3);
    for (int i = 0; i < n; ++i) v.row(i) << s.position_m[std::size_t(i)].x, s.position_m[std::size_t(i)].y, s.position_m[std::size_t(i)].z;
    Eigen::SparseMatrix<double> normal = matrix.transpose() * matrix;
    Eigen::MatrixXd right = matrix.transpose() * (matrix * v);
    for (std::size_t h = 0; h < handles.size(); ++h) {
      const double k2 = handles[h].weight * handles[h].weight;
      normal.coeffRef(handles[h].vertex, handles[h].vertex) += k2;
      right.row(handles[h].vertex) += k2 * Eigen::RowVector3d(target[h].x, target[h].y, target[h].z);
    }
    const Eigen::MatrixXd answer = Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>(normal).solve(right);
    LeafEditor editor(s, mode(EditMode::linear));
    editor.set_handles(handles);
    const auto& p = editor.drag(target);
    for (int i = 0; i < n; ++i)
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(p[std::size_t(i)][c], answer(i, c), 1e-8) << weight;
  }
}

TEST(LinearEdit, NothingMovesWhenNoHandleMoves) {
  const Surface s = test::sheet(kSide);
  const LaplaceSolver solver(cotangent_laplacian(s));
  const std::vector<double> weights(10, 10.0);
  const LaplacianEdit edit(handle_columns(solver, test::ten_handles(kSide)), weights);
  std::vector<glm::dvec3> out(s.position_m.size());
  edit.drag(s.position_m, places(s, ten()), out);
  EXPECT_LT(largest_difference(out, s.position_m), 1e-10);
}

TEST(LinearEdit, ResponseMatrixAndBackSubstitutionAgree) {
  const Surface s = test::sheet(kSide);
  const LaplaceSolver solver(cotangent_laplacian(s));
  const std::vector<double> weights(10, 10.0);
  const LaplacianEdit edit(handle_columns(solver, test::ten_handles(kSide)), weights);
  auto target = places(s, ten());
  target[6] += glm::dvec3(0, 0.1, 0.4);
  target[9] += glm::dvec3(0.2, 0, -0.4);
  std::vector<glm::dvec3> a(s.position_m.size()), b(a.size());
  edit.drag(s.position_m, target, a);
  edit.solve(solver, s.position_m, target, b);
  EXPECT_LT(largest_difference(a, b), 1e-9);
  EXPECT_GT(largest_difference(a, s.position_m), 0.3);
}

TEST(LinearEdit, TranslatesAndSuperposes) {
  const Surface s = test::sheet(kSide);
  LeafEditor editor(s, mode(EditMode::linear));
  editor.set_handles(ten());
  const auto home = places(s, ten());
  auto shifted = home;
  for (auto& p : shifted) p += glm::dvec3(1, 2, 3);
  auto moved = editor.drag(shifted);
  for (auto& p : moved) p -= glm::dvec3(1, 2, 3);
  EXPECT_LT(largest_difference(moved, s.position_m), 1e-10);

  auto first = home, second = home, both = home;
  first[1].z += 0.4, both[1].z += 0.4;
  second[8].x -= 0.3, both[8].x -= 0.3;
  const auto a = editor.drag(first), b = editor.drag(second), c = editor.drag(both);
  for (std::size_t i = 0; i < c.size(); ++i)
    ASSERT_LT(glm::length(c[i] - (a[i] + b[i] - s.position_m[i])), 1e-10);
}

TEST(LinearEdit, ReproducesAffineMotionsOfAPlane) {
  // Linear precision: L f = 0 inside for linear f. The rows of the border do not have it; they and what they touch are held.
  const int n = 13;
  const Surface s = test::crumpled_plane(n);
  LeafEditor editor(s, mode(EditMode::linear));
  std::vector<Handle> rim;
  for (int v = 0; v < n * n; ++v)
    if (std::min({v % n, v / n, n - 1 - v % n, n - 1 - v / n}) < 2) rim.push_back({v, 1e6});
  editor.set_handles(rim);
  const auto affine = [](const glm::dvec3& p) { return glm::dvec3(1.3 * p.x + 0.2 * p.y, 0.1 * p.x + 0.8 * p.y, 0.3 + 0.5 * p.x - p.y); };
  auto target = places(s, rim);
  for (auto& p : target) p = affine(p);
  auto wanted = s.position_m;
  for (auto& p : wanted) p = affine(p);
  EXPECT_LT(largest_difference(editor.drag(target), wanted), 1e-8);
}

TEST(Rotations, NearestRotationAgreesWithTheSingularValueDecomposition) {
  Random random(5, Stream::test, 9);
  for (int k = 0; k < 2000; ++k) {
    Mat3 s;
    for (double& v : s.m) v = random.uniform(-1, 1);
    if (k % 3 == 1)  // rank 2, as of a flat neighbourhood
      for (int c = 0; c < 3; ++c) s.m[6 + c] = 0;
    if (k % 7 == 0)
      for (double& v : s.m) v *= 1e-9;
    Eigen::Matrix3d m;
    for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = s.m[i];
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double sign = (svd.matrixU() * svd.matrixV()).determinant() < 0 ? -1 : 1;
    const double best = svd.singularValues()[0] + svd.singularValues()[1] + sign * svd.singularValues()[2];
    const Mat3 r = closest_rotation(s, Mat3{});
    const Mat3 rs = r * s;
    ASSERT_NEAR(rs.m[0] + rs.m[4] + rs.m[8], best, 1e-9 * svd.singularValues()[0]) << k;
    const double det = r.m[0] * (r.m[4] * r.m[8] - r.m[5] * r.m[7]) - r.m[1] * (r.m[3] * r.m[8] - r.m[5] * r.m[6]) +
                       r.m[2] * (r.m[3] * r.m[7] - r.m[4] * r.m[6]);
    ASSERT_NEAR(det, 1, 1e-12) << k;
  }
}

TEST(Rotations, WhatIsLeftOpenFollowsTheEarlierRotation) {
  Mat3 line = Mat3::zero();
  line.m[0] = 2;  // all edges along x stay along x: any turn about x fits
  const Mat3 before = about({1, 0, 0}, 0.7), r = closest_rotation(line, before);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(r.m[i], before.m[i], 1e-6);
  const Mat3 none = closest_rotation(Mat3::zero(), before);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(none.m[i], before.m[i]);
}

TEST(RotationAwareEdit, NothingMovesWhenNoHandleMoves) {
  const Surface s = test::sheet(kSide);
  const LaplaceSolver solver(cotangent_laplacian(s));
  ArapEdit edit(solver, s.position_m, surface_area_m2(s), 0.02);
  edit.set_handles(handle_columns(solver, test::ten_handles(kSide)));
  auto p = s.position_m;
  edit.drag(places(s, ten()), p, {5, 1e-14});
  EXPECT_LT(largest_difference(p, s.position_m), 1e-10);
  EXPECT_NEAR(edit.energy(p), 0, 1e-18);
}

TEST(RotationAwareEdit, RigidMotionOfTheHandlesIsRigidMotionOfTheLeaf) {
  const Surface s = test::sheet(kSide);
  for (const double angle : {0.1, 1.6, 3.1}) {
    const RigidMotion motion{about({0.3, -1, 0.5}, angle), {0.4, -2, 1}};
    LeafEditor editor(s, mode(EditMode::rotation_aware));
    editor.set_handles(ten());
    auto target = places(s, ten());
    for (auto& p : target) p = motion(p);
    auto wanted = s.position_m;
    for (auto& p : wanted) p = motion(p);
    EXPECT_LT(largest_difference(editor.drag(target), wanted), 1e-6) << angle;
    EXPECT_NEAR(editor.report().largest_strain, 0, 1e-6);
  }
}

/// One side is lifted and turned over by a quarter.
std::vector<glm::dvec3> curled(const Surface& s, double share) {
  auto target = places(s, ten());
  for (std::size_t h = 5; h < target.size(); ++h)
    target[h] = {target[h].x - 0.7 * share, target[h].y, target[h].z + 1.1 * share};
  return target;
}

TEST(RotationAwareEdit, KeepsAreaWhereTheLinearEditSwells) {
  const Surface s = test::sheet(kSide);
  EditReport reports[2];
  double energies[2];
  for (const EditMode m : {EditMode::linear, EditMode::rotation_aware}) {
    LeafEditor editor(s, mode(m));
    editor.set_handles(ten());
    for (int step = 1; step <= 10; ++step) editor.drag(curled(s, 0.1 * step));
    const int k = m == EditMode::rotation_aware;
    reports[k] = editor.report();
    const LaplaceSolver solver(cotangent_laplacian(s));
    energies[k] = ArapEdit(solver, s.position_m, surface_area_m2(s), 0.02).energy(editor.positions());
  }
  EXPECT_LT(std::abs(reports[1].area_drift), 0.8 * std::abs(reports[0].area_drift));
  EXPECT_LT(reports[1].rms_strain, reports[0].rms_strain);
  EXPECT_LT(energies[1], 0.8 * energies[0]);
}

TEST(RotationAwareEdit, HandlesEndOnTheirTargetsAndIterationsLeadToTheMinimum) {
  // A tenth of the way in one drag is nearly converged after 20 iterations. Half of the way in one drag passes a saddle, at which the
  // sheet must decide which way to buckle: it stays near it for some hundred iterations, then goes on to the minimum.
  const Surface s = test::sheet(kSide);
  for (const double share : {0.1, 0.5}) {
    std::vector<double> energies;
    for (const int iterations : {1, 8, 20, 600, 3000}) {
      LeafEditor editor(s, mode(EditMode::rotation_aware, iterations, 1e-13));
      editor.set_handles(ten());
      const auto target = curled(s, share);
      const auto& p = editor.drag(target);
      for (std::size_t h = 0; h < target.size(); ++h) EXPECT_EQ(p[std::size_t(editor.handles()[h].vertex)], target[h]);
      energies.push_back(editor.energy());
    }
    for (std::size_t k = 1; k < energies.size(); ++k) EXPECT_LE(energies[k], energies[k - 1] * (1 + 1e-9)) << share;
    if (share < 0.2) {
      EXPECT_NEAR(energies[2], energies[3], 0.001 * energies[3]);
    }
    EXPECT_NEAR(energies[3], energies[4], 1e-6 * energies[4]) << share;
  }
  // A minimum: pushing any free vertex about costs energy.
  LeafEditor editor(s, mode(EditMode::rotation_aware, 3000, 1e-14));
  editor.set_handles(ten());
  editor.drag(curled(s, 0.5));
  const LaplaceSolver solver(cotangent_laplacian(s));
  const ArapEdit edit(solver, s.position_m, surface_area_m2(s), 0.02);
  const double least = edit.energy(editor.positions());
  Random random(11, Stream::test, 3);
  for (int k = 0; k < 12; ++k) {
    auto p = editor.positions();
    const std::size_t v = std::size_t(1 + random.uniform() * (kSide - 2)) + std::size_t(kSide) * std::size_t(random.uniform() * kSide);
    p[v] += 0.01 * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    EXPECT_GT(edit.energy(p), least);
  }
}

TEST(RotationAwareEdit, SameBitsForAnyNumberOfThreads) {
  const Surface s = test::sheet(61);
  std::vector<glm::dvec3> first;
  for (const int threads : {1, 2, 3}) {
    const ThreadLimit limit(threads);
    LeafEditor editor(s, mode(EditMode::rotation_aware, 5));
    editor.set_handles({{0, 10}, {60, 10}, {61 * 61 - 1, 10}, {61 * 60, 10}});
    auto target = places(s, editor.handles());
    target[2] += glm::dvec3(-0.3, -0.2, 0.6);
    const auto& p = editor.drag(target);
    if (first.empty()) first = p;
    else
      for (std::size_t i = 0; i < p.size(); ++i) ASSERT_EQ(p[i], first[i]);
  }
}

}  // namespace
}  // namespace witherfield::leaf
