// The parts of the wilting leaf's mechanics: their energies, forces and second derivatives.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "sim/core/errors.hpp"
#include "sim/core/random.hpp"
#include "sim/leaf/contact.hpp"
#include "sim/leaf/leaf_tissue.hpp"
#include "sim/leaf/petiole_rod.hpp"
#include "sim/leaf/sheet_law.hpp"
#include "sim/leaf/shell.hpp"
#include "sim/leaf/step_path.hpp"
#include "sim/leaf/vein_ribs.hpp"
#include "tests/leaf/shapes.hpp"
#include "tests/leaf/wilt_bodies.hpp"

namespace witherfield::leaf {
namespace {

glm::dvec3 noise(Random& random, double size) {
  return size * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
}

double dot_all(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i], b[i]);
  return sum;
}

TEST(SheetLaw, IsTheIsotropicLawWithoutSoftening) {
  const double y = 3, nu = 0.3;
  const glm::dvec3 e(0.02, -0.03, 0.015);
  const SheetResponse r = sheet_response(e, y, nu, 1);
  const glm::dvec3 stress = y * glm::dvec3(e.x + nu * e.y, e.y + nu * e.x, (1 - nu) / 2 * e.z);
  EXPECT_LT(glm::length(r.force - stress), 1e-15);
  EXPECT_NEAR(r.energy, 0.5 * glm::dot(stress, e), 1e-16);
}

TEST(SheetLaw, ForceIsTheSlopeOfTheEnergyAndTheTangentThatOfTheForce) {
  Random random(3, Stream::test, 40);
  for (int k = 0; k < 200; ++k) {
    const glm::dvec3 e = noise(random, 0.1), d = noise(random, 1);
    const double c = random.uniform(0.01, 1), nu = random.uniform(0, 0.45), h = 1e-6;
    const SheetResponse at = sheet_response(e, 2, nu, c), up = sheet_response(e + h * d, 2, nu, c), down = sheet_response(e - h * d, 2, nu, c);
    EXPECT_NEAR(glm::dot(at.force, d), (up.energy - down.energy) / (2 * h), 1e-8);
    // The tangent jumps where a principal strain changes its sign: between both sides' values.
    EXPECT_GE(glm::dot(d, at.tangent * d), -1e-12);
    EXPECT_GE(glm::dot(up.force - down.force, d), 0) << "not convex";
    EXPECT_GE(at.energy, 0);
  }
}

TEST(SheetLaw, GivesWayToCompressionOnly) {
  const double full = sheet_response({0.01, 0, 0}, 1, 0, 0.05).energy, weak = sheet_response({-0.01, 0, 0}, 1, 0, 0.05).energy;
  EXPECT_NEAR(weak / full, 0.05, 1e-12);
}

/// A relief with two ribs across, far from its rest shape.
struct Crumpled {
  Surface sheet = test::sheet(7);
  std::vector<ShellPatch> patches = make_patches(sheet.position_m, sheet.triangles);
  Shell shell;
  std::vector<glm::dvec3> x = sheet.position_m;

  explicit Crumpled(double size = 0.03) : shell(patches, {}) {
    WiltBody body;
    body.rest = sheet;
    body.veins = {{{sheet.position_m[0], sheet.position_m[24], sheet.position_m[48]}, 0.05, 0.02}};
    body.clamp = {0};
    shell = Shell(patches, lay_ribs(body, patches).pieces);
    const ShellMaterial m{2.0, 3.0, 0.15, 0.3, -0.04, 0.3, 20.0, 1.0, 30.0, -0.01};
    shell.set_material(std::vector<ShellMaterial>(patches.size(), m));
    Random random(9, Stream::test, 41);
    for (glm::dvec3& p : x) p += noise(random, size);
  }
};

TEST(Shell, ForceIsTheSlopeOfTheEnergyAndTheMatrixThatOfTheForce) {
  Crumpled c;
  const std::size_t n = c.x.size();
  BlockMatrix h(std::vector<char>(n, 0), c.shell.couplings()), other(std::vector<char>(n, 0), c.shell.couplings());
  c.shell.bind(h);
  std::vector<glm::dvec3> g(n, glm::dvec3(0.0));
  const double e = c.shell.assemble(c.x, g, h, 1);
  EXPECT_NEAR(e, c.shell.energy(c.x), 1e-13 * e);
  Random random(5, Stream::test, 42);
  for (int k = 0; k < 6; ++k) {
    std::vector<glm::dvec3> d(n), up = c.x, down = c.x, hd(n);
    const double step = 1e-6;
    for (std::size_t i = 0; i < n; ++i) {
      d[i] = noise(random, 1);
      up[i] += step * d[i];
      down[i] -= step * d[i];
    }
    EXPECT_NEAR(dot_all(g, d), (c.shell.energy(up) - c.shell.energy(down)) / (2 * step), 1e-6 * std::abs(dot_all(g, d)) + 1e-8);
    h.multiply(d, hd);
    std::vector<glm::dvec3> gu(n, glm::dvec3(0.0)), gd(n, glm::dvec3(0.0));
    c.shell.assemble(up, gu, other, 0);
    c.shell.assemble(down, gd, other, 0);
    double largest = 0;
    for (const glm::dvec3& v : hd) largest = std::max(largest, glm::length(v));
    for (std::size_t i = 0; i < n; ++i) EXPECT_LT(glm::length(hd[i] - (gu[i] - gd[i]) / (2 * step)), 1e-5 * largest) << i;
  }
}

TEST(Shell, ConvexMatrixIsPositiveSemiDefinite) {
  Crumpled c(0.1);
  const std::size_t n = c.x.size();
  BlockMatrix h(std::vector<char>(n, 0), c.shell.couplings());
  c.shell.bind(h);
  std::vector<glm::dvec3> g(n, glm::dvec3(0.0));
  c.shell.assemble(c.x, g, h, 0);
  h.add_to_diagonal(1e-9 * h.mean_diagonal());
  EXPECT_NO_THROW(SparseCholesky factor(h.scalar(), Factor::blocked));
}

TEST(Shell, RigidMotionsCostNothingAndForcesAndTorquesCancel) {
  Crumpled c;
  const double before = c.shell.energy(c.x);
  std::vector<glm::dvec3> turned_x = c.x;
  const glm::dquat q = turned(glm::dquat(1, 0, 0, 0), {0.4, -1.1, 2.0});
  for (glm::dvec3& p : turned_x) p = q * p + glm::dvec3(3, -1, 2);
  EXPECT_NEAR(c.shell.energy(turned_x), before, 1e-11 * before);
  BlockMatrix h(std::vector<char>(c.x.size(), 0), c.shell.couplings());
  c.shell.bind(h);
  std::vector<glm::dvec3> g(c.x.size(), glm::dvec3(0.0));
  c.shell.assemble(c.x, g, h, 0);
  glm::dvec3 force(0.0), torque(0.0);
  double size = 0;
  for (std::size_t i = 0; i < g.size(); ++i) force += g[i], torque += glm::cross(c.x[i], g[i]), size += glm::length(g[i]);
  EXPECT_LT(glm::length(force), 1e-12 * size);
  EXPECT_LT(glm::length(torque), 1e-12 * size);
}

TEST(Shell, BentToACylinderItHasThePlatesEnergy) {
  // Bending about one axis with the other held straight: E h^3 / (24 (1 - nu^2)) kappa^2 per area. Triangles at the margin lack a hinge
  // and have less: an error of the first order of the mesh.
  const double radius = 4, thickness = 0.05, nu = 0.3, modulus = 7;
  const double per_area = modulus * std::pow(thickness, 3) / (24 * (1 - nu * nu)) / (radius * radius);
  double missing[2];
  for (const int n : {40, 80}) {
    WiltBody b = test::strip(2, 2, n, n);
    const auto patches = make_patches(b.rest.position_m, b.rest.triangles);
    Shell shell(patches, {});
    shell.set_material(std::vector<ShellMaterial>(patches.size(), {1e-12, modulus, thickness, nu, 0, 0, 0, 1}));
    std::vector<glm::dvec3> x = b.rest.position_m;
    for (glm::dvec3& p : x) p = {radius * std::sin(p.x / radius), p.y, radius * (1 - std::cos(p.x / radius))};
    missing[n == 80] = 1 - shell.energy(x) / (4 * per_area);
  }
  EXPECT_LT(std::abs(missing[0]), 0.03);
  EXPECT_NEAR(missing[0] / missing[1], 2, 0.1);
}

TEST(Shell, ShrinkageAloneMakesItSmallerWithoutEnergy) {
  WiltBody b = test::strip(1, 1, 6, 6);
  const auto patches = make_patches(b.rest.position_m, b.rest.triangles);
  Shell shell(patches, {});
  shell.set_material(std::vector<ShellMaterial>(patches.size(), {5, 5, 0.1, 0.3, -0.1, 0, 0, 1}));
  std::vector<glm::dvec3> x = b.rest.position_m;
  EXPECT_GT(shell.energy(x), 1e-3);
  for (glm::dvec3& p : x) p *= 0.9;
  EXPECT_NEAR(shell.energy(x), 0, 1e-15);
  for (const double s : shell.von_mises_MPa(x)) EXPECT_NEAR(s, 0, 1e-12);
}

TEST(PetioleRod, ForceIsTheSlopeOfTheEnergyAndTheMatrixThatOfTheForce) {
  // Two vertices of a blade are held by the rod's end.
  const std::vector<glm::dvec3> blade{{0.11, 0.01, 0.05}, {0.11, -0.01, 0.05}};
  const std::vector<glm::dvec3> line{{0, 0, 0}, {0.05, 0, 0.01}, {0.1, 0.0, 0.05}};
  const int segments = 5, nodes = 2 + segments + 1;
  PetioleRod rod(line, 0.003, 0.002, segments, 2, nodes, {0, 1}, blade);
  rod.set_modulus(std::vector<double>(segments, 3e6));
  WiltShape s;
  s.x = blade;
  s.x.insert(s.x.end(), rod.rest_m().begin(), rod.rest_m().end());
  s.frame = rod.rest_frames();
  const std::size_t n = s.x.size() + s.frame.size();
  EXPECT_NEAR(rod.energy(s), 0, 1e-20);
  Random random(2, Stream::test, 43);
  for (glm::dvec3& p : s.x) p += noise(random, 1e-3);
  for (glm::dquat& q : s.frame) q = turned(q, noise(random, 0.1));
  BlockMatrix h(std::vector<char>(n, 0), rod.couplings()), other(std::vector<char>(n, 0), rod.couplings());
  std::vector<glm::dvec3> g(n, glm::dvec3(0.0));
  rod.assemble(s, g, h, 1);
  const auto moved = [&](std::span<const glm::dvec3> d, double share) {
    WiltShape to = s;
    for (std::size_t i = 0; i < to.x.size(); ++i) to.x[i] += share * d[i];
    for (std::size_t k = 0; k < to.frame.size(); ++k) to.frame[k] = turned(to.frame[k], share * d[to.x.size() + k]);
    return to;
  };
  for (int k = 0; k < 6; ++k) {
    std::vector<glm::dvec3> d(n), hd(n);
    for (std::size_t i = 0; i < n; ++i) d[i] = noise(random, i < s.x.size() ? 1e-2 : 1);
    const double t = 1e-4;
    const double up = rod.energy(moved(d, t)), down = rod.energy(moved(d, -t)), middle = rod.energy(s);
    EXPECT_NEAR(dot_all(g, d), (up - down) / (2 * t), 1e-5 * std::abs(dot_all(g, d)) + 1e-9);
    // d^T H d: second difference along exp(t d), whose curve is a geodesic of the rotations.
    h.multiply(d, hd);
    EXPECT_NEAR(dot_all(d, hd), (up - 2 * middle + down) / (t * t), 1e-4 * std::abs(dot_all(d, hd)));
  }
}

TEST(Contact, PushesPairsApartAndLetsNothingThrough) {
  const std::vector<glm::dvec3> rest{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Contact contact(rest, {0.1, 0.1, 0.1}, 0.3);
  std::vector<glm::dvec3> x{{0, 0, 0}, {0.12, 0.02, 0.05}, {0, 1, 0}};
  EXPECT_EQ(contact.touching(rest), 0);
  EXPECT_EQ(contact.touching(x), 1);
  BlockMatrix h(std::vector<char>(3, 0), {{0, 1}, {1, 2}});
  std::vector<glm::dvec3> g(3, glm::dvec3(0.0)), same(3, glm::dvec3(0.0));
  EXPECT_NEAR(contact.assemble(x, g, h), contact.energy(x), 1e-18);
  for (int c = 0; c < 3; ++c) {
    auto up = x, down = x;
    up[1][c] += 1e-7, down[1][c] -= 1e-7;
    EXPECT_NEAR(g[1][c], (contact.energy(up) - contact.energy(down)) / 2e-7, 1e-6 * glm::length(g[1]) + 1e-9);
  }
  EXPECT_LT(glm::length(g[0] + g[1]), 1e-15);
  // Straight through the other, in one step: both ends are far apart, the way is not.
  auto from = rest, to = rest;
  to[1] = {-1, 0.01, 0};
  EXPECT_FALSE(contact.allows(from, to));
  to[1] = {-1, 0.9, 0.5};
  EXPECT_TRUE(contact.allows(from, to));
}

TEST(StepPath, IsTheStraightStepToFirstOrderAndDoesNotStretchWhatTurns) {
  const WiltBody b = test::cantilever(1, 0.2, 20, 4);
  const auto patches = make_patches(b.rest.position_m, b.rest.triangles);
  Shell shell(patches, {});
  shell.set_material(std::vector<ShellMaterial>(patches.size(), {1, 1, 1e-4, 0.3, 0, 0, 0, 1}));
  const StepPath path(b.rest.position_m, patches, b.clamp, 0);
  WiltShape s;
  s.x = b.rest.position_m;
  std::vector<glm::dvec3> step(s.x.size());
  for (std::size_t i = 0; i < step.size(); ++i) {
    const double x = std::max(0.0, s.x[i].x - 0.05);
    step[i] = {0, 0, -0.6 * x * x};  // bends downwards, by a good half radian at its end
  }
  const WiltShape little = path.at(s, step, 1e-5), whole = path.at(s, step, 1);
  for (std::size_t i = 0; i < step.size(); ++i) EXPECT_LT(glm::distance(little.x[i], s.x[i] + 1e-5 * step[i]), 1e-9);
  auto straight = s.x;
  for (std::size_t i = 0; i < step.size(); ++i) straight[i] += step[i];
  EXPECT_LT(shell.energy(whole.x), 0.01 * shell.energy(straight));
}

TEST(LeafTissue, TurgorFollowsThePressureVolumeCurve) {
  WiltTissueOptions t;
  t.osmotic_potential_MPa = -1.2;
  t.wall_elasticity_MPa = 8;
  EXPECT_NEAR(turgor_loss_point(t), 0.85, 1e-12);  // (pi_0 + epsilon) / epsilon
  EXPECT_NEAR(turgor_MPa(t, 1), 1.2, 1e-12);
  EXPECT_NEAR(turgor_MPa(t, 0.9), 0.4, 1e-12);
  EXPECT_EQ(turgor_MPa(t, 0.84), 0);
  // Stiffness falls, shrinkage grows, and nothing jumps, all the way to dry.
  for (double w = 1; w > 0.01; w -= 0.01) {
    EXPECT_GE(blade_bending_MPa(t, w), blade_bending_MPa(t, w - 0.01));
    EXPECT_GE(petiole_modulus_MPa(t, w), petiole_modulus_MPa(t, w - 0.01));
    EXPECT_GE(vein_modulus_MPa(t, w), blade_membrane_MPa(t, w));
    EXPECT_LE(shrink_strain(t, w - 0.01, 0), shrink_strain(t, w, 0));
    EXPECT_LE(shrink_strain(t, w, 0), shrink_strain(t, w, 1));  // mesophyll shrinks more than veins
    EXPECT_GE(transpiration_share(t, 0.15, w), transpiration_share(t, 0.15, w - 0.01));
  }
  EXPECT_EQ(shrink_strain(t, 1, 0.3), 0);
  EXPECT_NEAR(transpiration_share(t, 0.15, 1), 1, 1e-12);
  EXPECT_NEAR(transpiration_share(t, 0.15, 0), 0, 1e-12);
}

}  // namespace
}  // namespace witherfield::leaf
