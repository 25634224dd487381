#include "sim/leaf/shell.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/core/parallel.hpp"
#include "sim/leaf/hinge.hpp"

namespace witherfield::leaf {
namespace {

constexpr std::size_t kGrain = 512;

/// Corner or far corner `local` (0..5) of a patch; -1 when there is none.
int node_of(const ShellPatch& p, int local) {
  return local < 3 ? p.corner[std::size_t(local)] : p.across[std::size_t(local - 3)];
}

/// (1 - nu^2) C / E of plane stress on (11, 22, 2x12).
glm::dmat3 plane_stress(double nu) { return {1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2}; }

/// Takes hinge b out by letting it have the angle of least energy (static condensation).
void condense(glm::dmat3& m, int b) {
  const double d = m[b][b];
  const glm::dmat3 old = m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[i][j] = i == b || j == b || d <= 0 ? 0.0 : old[i][j] - old[b][i] * old[b][j] / d;
}

/// Positive part of a symmetric 2 x 2 tensor (11, 22, 12): what pulls.
glm::dvec3 tension_part(const glm::dvec3& s) {
  const double mean = (s.x + s.y) / 2, half = (s.x - s.y) / 2, r = std::hypot(half, s.z);
  const double lo = mean - r, hi = mean + r;
  if (lo >= 0) return s;
  if (hi <= 0) return glm::dvec3(0.0);
  const double k = hi / (2 * r);  // hi n n^T with n the major direction
  return {k * (r + half), k * (r - half), k * s.z};
}

}  // namespace

namespace {

/// Adds moment * second derivatives of a hinge whose corners i, j, k, o are those local nodes.
void add_turning(const HingeHessian& h, double moment, const std::array<std::size_t, 4>& node, std::array<glm::dmat3, 21>& to) {
  const auto add = [&](int a, int b, const glm::dmat3& block) {
    const std::size_t r = node[std::size_t(a)], c = node[std::size_t(b)];
    if (r >= c) to[r * (r + 1) / 2 + c] += moment * block;
    else to[c * (c + 1) / 2 + r] += moment * glm::transpose(block);
  };
  add(0, 0, h.ii);
  add(0, 1, h.ij);
  add(0, 2, h.ik);
  add(3, 3, h.oo);
  add(3, 1, h.oj);
  add(3, 2, h.ok);
  add(1, 1, h.jj);
  add(1, 2, h.jk);
  add(2, 2, h.kk);
}

}  // namespace

Shell::Shell(std::vector<ShellPatch> patches, std::vector<RibPiece> ribs)
    : patches_(std::move(patches)),
      ribs_(std::move(ribs)),
      rib_start_(patches_.size() + 1, 0),
      preload_strain_(patches_.size(), glm::dvec3(0.0)),
      preload_angle_(patches_.size(), glm::dvec3(0.0)) {
  for (const RibPiece& r : ribs_) ++rib_start_[std::size_t(r.triangle) + 1];
  for (std::size_t t = 0; t < patches_.size(); ++t) rib_start_[t + 1] += rib_start_[t];
}

Shell::Stiffness Shell::stiffness(std::size_t t, const ShellMaterial& m) const {
  const ShellPatch& p = patches_[t];
  const double nu = m.poisson, h = m.thickness_m;
  Stiffness s;
  s.scale = 1 / ((1 + m.shrink_strain) * (1 + m.shrink_strain));
  s.rib_scale = 1 / ((1 + m.rib_shrink_strain) * (1 + m.rib_shrink_strain));
  s.sheet = m.membrane_Pa * h / (1 - nu * nu) * p.area_m2;
  s.poisson = nu;
  s.compression = m.compression;
  s.ribs = glm::dmat3(0.0);
  const glm::dmat3 plate = plane_stress(nu) * (m.bending_Pa * h * h * h / 12 / (1 - nu * nu) * p.area_m2);
  glm::dmat3 a;  // column i: curvature (11, 22, 2x12) per unit angle of hinge i
  for (int i = 0; i < 3; ++i) {
    const glm::dvec2 g = p.gradient[std::size_t(i)];
    a[i] = p.height_m(i) * glm::dvec3(g.x * g.x, g.y * g.y, 2 * g.x * g.y);
    s.angle[std::size_t(i)] = m.curvature_1_m * p.edge_m(i) * p.cotangent(i);  // kappa* = curvature * identity
  }
  s.bending = glm::transpose(a) * plate * a;
  for (int k = rib_start_[t]; k < rib_start_[t + 1]; ++k) {
    const RibPiece& rib = ribs_[std::size_t(k)];
    const glm::dvec2 d = rib.direction, across(-d.y, d.x);
    const double r2 = rib.radius_m * rib.radius_m, area = std::numbers::pi * r2, inertia = area * r2 / 4;
    const glm::dvec3 along(d.x * d.x, d.y * d.y, d.x * d.y);
    s.ribs += glm::outerProduct(along, along) * (m.rib_axial_Pa * area * rib.length_m);
    glm::dvec3 bend, twist;
    for (int i = 0; i < 3; ++i) {
      const glm::dvec2 g = p.gradient[std::size_t(i)];
      bend[i] = p.height_m(i) * glm::dot(g, d) * glm::dot(g, d);
      twist[i] = p.height_m(i) * glm::dot(g, d) * glm::dot(g, across);
    }
    const double shear = m.rib_Pa / 3;  // nearly incompressible tissue: G = E / 3; polar moment = 2 I
    s.bending += glm::outerProduct(bend, bend) * (m.rib_Pa * inertia * rib.length_m) +
                 glm::outerProduct(twist, twist) * (shear * 2 * inertia * rib.length_m);
  }
  for (int i = 0; i < 3; ++i)
    if (p.across[std::size_t(i)] < 0) condense(s.bending, i);
  return s;
}

void Shell::set_material(std::span<const ShellMaterial> material) {
  material_.assign(material.begin(), material.end());
  stiffness_.resize(patches_.size());
  parallel_for(patches_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) stiffness_[t] = stiffness(t, material_[t]);
  });
}

std::vector<std::pair<int, int>> Shell::couplings() const {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(patches_.size() * 15);
  for (const ShellPatch& p : patches_)
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < a; ++b)
        if (node_of(p, a) >= 0 && node_of(p, b) >= 0) pairs.emplace_back(node_of(p, a), node_of(p, b));
  return pairs;
}

void Shell::bind(const BlockMatrix& h) {
  slot_.resize(patches_.size());
  parallel_for(patches_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      for (int a = 0, k = 0; a < 6; ++a)
        for (int b = 0; b <= a; ++b, ++k) {
          const int i = node_of(patches_[t], a), j = node_of(patches_[t], b);
          slot_[t][std::size_t(k)] = i >= 0 && j >= 0 ? h.slot(i, j) : -1;
        }
  });
}

Shell::Strain Shell::measure(std::size_t t, std::span<const glm::dvec3> x) const {
  const ShellPatch& p = patches_[t];
  const Stiffness& s = stiffness_[t];
  Strain m;
  m.f1 = m.f2 = glm::dvec3(0.0);
  std::array<glm::dvec3, 3> q;
  for (std::size_t i = 0; i < 3; ++i) {
    q[i] = x[std::size_t(p.corner[i])];
    m.f1 += q[i] * p.gradient[i].x;
    m.f2 += q[i] * p.gradient[i].y;
  }
  const glm::dvec3 half_square(glm::dot(m.f1, m.f1) / 2, glm::dot(m.f2, m.f2) / 2, glm::dot(m.f1, m.f2));
  const glm::dvec3 at_rest = glm::dvec3(0.5, 0.5, 0) + preload_strain_[t];
  m.strain = s.scale * half_square - at_rest;
  m.rib_strain = s.rib_scale * half_square - at_rest;
  m.angle = glm::dvec3(0.0);
  for (std::size_t i = 0; i < 3; ++i)
    if (p.across[i] >= 0)
      m.angle[int(i)] = hinge_angle(q[i], q[(i + 1) % 3], q[(i + 2) % 3], x[std::size_t(p.across[i])]) - p.rest_angle[i] -
                        s.angle[i] - preload_angle_[t][int(i)];
  return m;
}

SheetResponse Shell::membrane(std::size_t t, const Strain& m) const {
  const Stiffness& s = stiffness_[t];
  SheetResponse r = sheet_response(m.strain, s.sheet, s.poisson, s.compression);
  const glm::dvec3 ribs = s.ribs * m.rib_strain;
  r.energy += 0.5 * glm::dot(m.rib_strain, ribs);
  r.force = s.scale * r.force + s.rib_scale * ribs;
  r.tangent = s.scale * s.scale * r.tangent + s.rib_scale * s.rib_scale * s.ribs;
  return r;
}

double Shell::energy(std::span<const glm::dvec3> x) const {
  std::vector<double> part(patches_.size());
  parallel_for(patches_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Strain m = measure(t, x);
      part[t] = membrane(t, m).energy + 0.5 * glm::dot(m.angle, stiffness_[t].bending * m.angle);
    }
  });
  double sum = 0;  // in the order of the triangles: the same bits for any thread count
  for (const double e : part) sum += e;
  return sum;
}

void Shell::element(std::size_t t, std::span<const glm::dvec3> x, double exactness, Local& out) const {
  const ShellPatch& p = patches_[t];
  const Stiffness& s = stiffness_[t];
  const Strain m = measure(t, x);
  const SheetResponse sheet = membrane(t, m);
  const glm::dvec3 force = sheet.force, moment = s.bending * m.angle;
  out.energy = sheet.energy + 0.5 * glm::dot(m.angle, moment);
  out.gradient.fill(glm::dvec3(0.0));
  out.hessian.fill(glm::dmat3(0.0));

  std::array<glm::dmat3, 3> b;  // column k of b[a]: d (F^T F / 2)_k / d x_a
  for (std::size_t a = 0; a < 3; ++a) {
    const glm::dvec2 g = p.gradient[a];
    b[a] = glm::dmat3(g.x * m.f1, g.y * m.f2, g.x * m.f2 + g.y * m.f1);
    out.gradient[a] = b[a] * force;
  }
  const glm::dvec3 pull = glm::mix(tension_part(force), force, exactness);
  for (std::size_t a = 0, k = 0; a < 3; ++a)
    for (std::size_t c = 0; c <= a; ++c, ++k) {
      const glm::dvec2 g = p.gradient[a], q = p.gradient[c];
      const double geometric = g.x * (pull.x * q.x + pull.z * q.y) + g.y * (pull.z * q.x + pull.y * q.y);
      out.hessian[k] = b[a] * sheet.tangent * glm::transpose(b[c]) + glm::dmat3(geometric);
    }

  std::array<std::array<glm::dvec3, 3>, 6> u{};  // u[a][i]: d angle_i / d x_a
  for (std::size_t i = 0; i < 3; ++i) {
    if (p.across[i] < 0) continue;
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const HingeGradient g = hinge_gradient(x[std::size_t(p.corner[i])], x[std::size_t(p.corner[j])], x[std::size_t(p.corner[k])],
                                           x[std::size_t(p.across[i])]);
    u[i][i] = g.i;
    u[j][i] = g.j;
    u[k][i] = g.k;
    u[3 + i][i] = g.o;
    if (exactness > 0)
      add_turning(hinge_hessian(x[std::size_t(p.corner[i])], x[std::size_t(p.corner[j])], x[std::size_t(p.corner[k])],
                                x[std::size_t(p.across[i])]),
                  exactness * moment[int(i)], {i, j, k, 3 + i}, out.hessian);
  }
  for (std::size_t a = 0, k = 0; a < 6; ++a) {
    const glm::dmat3 ua(u[a][0], u[a][1], u[a][2]);
    out.gradient[a] += ua * moment;
    const glm::dmat3 ma = ua * s.bending;
    for (std::size_t c = 0; c <= a; ++c, ++k) out.hessian[k] += ma * glm::transpose(glm::dmat3(u[c][0], u[c][1], u[c][2]));
  }
}

double Shell::assemble(std::span<const glm::dvec3> x, std::span<glm::dvec3> gradient, BlockMatrix& h, double exactness) const {
  local_.resize(patches_.size());
  std::vector<Local>& local = local_;
  parallel_for(patches_.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) element(t, x, exactness, local[t]);
  });
  double sum = 0;
  for (std::size_t t = 0; t < patches_.size(); ++t) {
    sum += local[t].energy;
    for (int a = 0, k = 0; a < 6; ++a) {
      const int i = node_of(patches_[t], a);
      if (i >= 0) gradient[std::size_t(i)] += local[t].gradient[std::size_t(a)];
      for (int c = 0; c <= a; ++c, ++k)
        h.add(slot_[t][std::size_t(k)], i, node_of(patches_[t], c), local[t].hessian[std::size_t(k)]);
    }
  }
  return sum;
}

void Shell::preload(std::span<const glm::dvec3> rest, std::span<const glm::dvec3> u) {
  for (std::size_t t = 0; t < patches_.size(); ++t) {
    const ShellPatch& p = patches_[t];
    const Strain m = measure(t, rest);
    glm::dvec3 strain(0.0), angle(0.0);
    for (std::size_t a = 0; a < 3; ++a) {
      const glm::dvec2 g = p.gradient[a];
      const glm::dvec3 d = u[std::size_t(p.corner[a])];
      strain += glm::dvec3(g.x * glm::dot(m.f1, d), g.y * glm::dot(m.f2, d), glm::dot(g.x * m.f2 + g.y * m.f1, d));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if (p.across[i] < 0) continue;
      const int c = p.corner[i], j = p.corner[(i + 1) % 3], k = p.corner[(i + 2) % 3], o = p.across[i];
      const HingeGradient g = hinge_gradient(rest[std::size_t(c)], rest[std::size_t(j)], rest[std::size_t(k)], rest[std::size_t(o)]);
      angle[int(i)] = glm::dot(g.i, u[std::size_t(c)]) + glm::dot(g.j, u[std::size_t(j)]) + glm::dot(g.k, u[std::size_t(k)]) +
                      glm::dot(g.o, u[std::size_t(o)]);
    }
    preload_strain_[t] -= strain;
    preload_angle_[t] -= angle;
  }
}

std::vector<double> Shell::von_mises_MPa(std::span<const glm::dvec3> x) const {
  std::vector<double> result(patches_.size());
  for (std::size_t t = 0; t < patches_.size(); ++t) {
    const ShellPatch& p = patches_[t];
    const ShellMaterial& m = material_[t];
    const Strain s = measure(t, x);
    const glm::dmat3 c = plane_stress(m.poisson) * (1 / (1 - m.poisson * m.poisson));
    const glm::dvec3 middle =
        sheet_response(s.strain, m.membrane_Pa / (1 - m.poisson * m.poisson), m.poisson, m.compression).force;
    glm::dvec3 curvature(0.0);
    for (int i = 0; i < 3; ++i) {
      const glm::dvec2 g = p.gradient[std::size_t(i)];
      curvature += s.angle[i] * p.height_m(i) * glm::dvec3(g.x * g.x, g.y * g.y, 2 * g.x * g.y);
    }
    const glm::dvec3 bend = c * curvature * (m.bending_Pa * m.thickness_m / 2);
    for (const double side : {-1.0, 1.0}) {
      const glm::dvec3 q = middle + side * bend;
      const double v = std::sqrt(std::max(0.0, q.x * q.x - q.x * q.y + q.y * q.y + 3 * q.z * q.z));
      result[t] = std::max(result[t], v * 1e-6);
    }
  }
  return result;
}

}  // namespace witherfield::leaf
