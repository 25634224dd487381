#include "sim/floor/orientation_field.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/core/errors.hpp"

namespace witherfield::floor {

using Matrix = Eigen::SparseMatrix<double>;
using Solver = Eigen::SimplicialLLT<Matrix>;

struct FieldSolver::Factor {
  Solver solver;
};

namespace {

/// Gives cells without a value (known = 0) the mean of their neighbours that have one, `times` cells outward.
void spread_outward(const NavShape& s, std::vector<std::vector<float>*> values, std::vector<char> known, int times) {
  const std::ptrdiff_t nx = s.nx, offsets[8] = {-1, 1, -nx, nx, -nx - 1, -nx + 1, nx - 1, nx + 1};
  for (int t = 0; t < times; ++t) {
    std::vector<std::size_t> gained;
    for (int j = 1; j + 1 < s.ny; ++j)
      for (int i = 1; i + 1 < s.nx; ++i) {
        const std::size_t c = std::size_t(j) * std::size_t(nx) + std::size_t(i);
        if (known[c]) continue;
        int n = 0;
        for (const std::ptrdiff_t o : offsets) n += known[std::size_t(std::ptrdiff_t(c) + o)];
        if (n == 0) continue;
        for (std::vector<float>* v : values) {
          float sum = 0;
          for (const std::ptrdiff_t o : offsets)
            if (const std::size_t m = std::size_t(std::ptrdiff_t(c) + o); known[m]) sum += (*v)[m];
          (*v)[c] = sum / float(n);
        }
        gained.push_back(c);
      }
    for (const std::size_t c : gained) known[c] = 1;
  }
}

std::vector<char> free_mask(const NavGrid& grid) {
  std::vector<char> mask(grid.shape().cells());
  for (std::size_t c = 0; c < mask.size(); ++c) mask[c] = grid.free(c);
  return mask;
}

/// Separable binomial smoothing with the standard deviation sd_m.
void smooth(const NavShape& s, std::vector<float>& v, double sd_m) {
  const int passes = std::max(1, int(std::lround(2 * std::pow(sd_m / s.spacing_m, 2))));
  std::vector<float> w(v.size());
  const int nx = s.nx, ny = s.ny;
  const auto at = [&](const std::vector<float>& a, int i, int j) {
    return a[std::size_t(std::clamp(j, 0, ny - 1)) * std::size_t(nx) + std::size_t(std::clamp(i, 0, nx - 1))];
  };
  for (int p = 0; p < passes; ++p) {
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        w[std::size_t(j) * std::size_t(nx) + std::size_t(i)] = 0.25f * (at(v, i - 1, j) + 2 * at(v, i, j) + at(v, i + 1, j));
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        v[std::size_t(j) * std::size_t(nx) + std::size_t(i)] = 0.25f * (at(w, i, j - 1) + 2 * at(w, i, j) + at(w, i, j + 1));
  }
}

void normalise(OrientationField& f) {
  for (std::size_t c = 0; c < f.x.size(); ++c)
    if (const float l = std::hypot(f.x[c], f.y[c]); l > 0) f.x[c] /= l, f.y[c] /= l;
}

}  // namespace

glm::dvec2 OrientationField::at(const NavShape& shape, const NavShape::Spot& spot) const {
  const glm::dvec2 e{shape.sample(x, spot), shape.sample(y, spot)};
  const double l = glm::length(e);
  return l > 1e-9 ? e / l : glm::dvec2(0.0);
}

double RoundField::phi(const NavShape& shape, glm::dvec2 p) const {
  const glm::dvec2 d = p - middle_m;
  return shape.sample(psi, shape.spot(p)) + std::atan2(d.y, d.x) / (2 * std::numbers::pi);
}

FieldSolver::FieldSolver(const NavGrid& grid, double reach_m)
    : grid_(grid), reach_m_(reach_m), factor_(std::make_unique<Factor>()) {
  const NavShape& s = grid.shape();
  // Long ways over a short range would leave the range of doubles: e^-600.
  reach_m_ = std::max(reach_m, (s.nx + s.ny) * s.spacing_m / 250);
  const double k = std::pow(reach_m_ / s.spacing_m, 2);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(std::size_t(grid.free_cells()) * 3);
  for (std::size_t c = 0; c < s.cells(); ++c) {
    if (!grid.free(c)) continue;
    const int row = grid.index()[c];
    entries.emplace_back(row, row, 1 + 4 * k);  // walls: u = 0, so their links stay in the diagonal
    for (const std::size_t n : {c - 1, c - std::size_t(s.nx)})
      if (grid.free(n)) entries.emplace_back(row, grid.index()[n], -k);
  }
  Matrix a(grid.free_cells(), grid.free_cells());
  a.setFromTriplets(entries.begin(), entries.end());
  factor_->solver.compute(a);
  if (factor_->solver.info() != Eigen::Success)
    throw SolverFailure("FieldSolver: the orientation field's matrix of " + std::to_string(grid.free_cells()) +
                        " cells could not be factorised");
}

FieldSolver::~FieldSolver() = default;

OrientationField FieldSolver::towards(const std::vector<std::size_t>& sources) const {
  const NavShape& s = grid_.shape();
  Eigen::VectorXd b = Eigen::VectorXd::Zero(grid_.free_cells());
  for (const std::size_t c : sources) b[grid_.index()[c]] = 1;
  const Eigen::VectorXd u = factor_->solver.solve(b);
  OrientationField f;
  f.x.resize(s.cells());
  f.y.resize(s.cells());
  f.way_m.resize(s.cells());
  const double top = u.maxCoeff();
  const std::vector<char> connected = grid_.reachable(sources.front());
  const auto value = [&](std::size_t c) { return grid_.free(c) ? u[grid_.index()[c]] : 0.0; };
  for (std::size_t c = 0; c < s.cells(); ++c) {
    if (!connected[c]) continue;
    const double here = value(c);
    if (!(here > 1e-290))
      throw SolverFailure("FieldSolver: no way found at " + std::to_string(s.centre_m(int(c % std::size_t(s.nx)), 0).x) +
                          " m; raise gait.reach_m = " + std::to_string(reach_m_) + " m");
    const std::size_t nx = std::size_t(s.nx);
    f.x[c] = float((value(c + 1) - value(c - 1)) / here);
    f.y[c] = float((value(c + nx) - value(c - nx)) / here);
    f.way_m[c] = float(-reach_m_ * std::log(here / top));
  }
  normalise(f);
  spread_outward(s, {&f.x, &f.y, &f.way_m}, connected, 4);
  return f;
}

RoundField FieldSolver::round() const {
  const NavShape& s = grid_.shape();
  RoundField r;
  // The middle: the place farthest from all walls; of several, the one nearest to their centre of gravity.
  std::vector<float> lane = grid_.wall_distances();
  r.widest_m = *std::max_element(lane.begin(), lane.end());
  glm::dvec2 centre(0.0);
  double count = 0;
  for (int pass = 0; pass < 2; ++pass) {
    double nearest = 1e30;
    for (int j = 0; j < s.ny; ++j)
      for (int i = 0; i < s.nx; ++i)
        if (lane[std::size_t(j) * std::size_t(s.nx) + std::size_t(i)] > 0.97 * r.widest_m) {
          const glm::dvec2 p = s.centre_m(i, j);
          if (pass == 0) centre += p, count += 1;
          if (const double d = glm::distance(p, centre / count); pass == 1 && d < nearest) nearest = d, r.middle_m = p;
        }
  }
  r.middle_m += 1e-3 * s.spacing_m;  // not on a cell centre, where the angle has no value

  const auto angle = [&](std::size_t c) {
    const glm::dvec2 d = s.centre_m(int(c % std::size_t(s.nx)), int(c / std::size_t(s.nx))) - r.middle_m;
    return std::atan2(d.y, d.x) / (2 * std::numbers::pi);
  };
  const auto turn = [&](std::size_t from, std::size_t to) {
    const double d = angle(to) - angle(from);
    return d - std::round(d);
  };
  const double core = std::min(2.2, 0.75 * r.widest_m);
  const auto sigma = [&](std::size_t a, std::size_t b) {
    return 0.02 + 0.98 / (1 + std::pow(0.5 * (lane[a] + lane[b]) / core, 6));
  };
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(grid_.free_cells());
  for (std::size_t c = 0; c < s.cells(); ++c) {
    if (!grid_.free(c)) continue;
    const int row = grid_.index()[c];
    entries.emplace_back(row, row, 1e-9);  // phi is determined up to a constant on every island of ground
    for (const std::size_t n : {c - 1, c - std::size_t(s.nx)}) {
      if (!grid_.free(n)) continue;
      const int other = grid_.index()[n];
      const double k = sigma(c, n), t = turn(n, c);
      entries.emplace_back(row, row, k);
      entries.emplace_back(other, other, k);
      entries.emplace_back(row, other, -k);
      b[row] -= k * t;
      b[other] += k * t;
    }
  }
  Matrix a(grid_.free_cells(), grid_.free_cells());
  a.setFromTriplets(entries.begin(), entries.end());
  Solver solver(a);
  if (solver.info() != Eigen::Success) throw SolverFailure("FieldSolver: the round of the room has no solution");
  const Eigen::VectorXd psi = solver.solve(b);

  r.psi.resize(s.cells());
  r.direction.x.resize(s.cells());
  r.direction.y.resize(s.cells());
  const auto rise = [&](std::size_t from, std::size_t to) {
    return grid_.free(from) && grid_.free(to)
               ? psi[grid_.index()[to]] - psi[grid_.index()[from]] + turn(from, to)
               : 0.0;  // no flow through walls
  };
  for (std::size_t c = 0; c < s.cells(); ++c) {
    if (!grid_.free(c)) continue;
    r.psi[c] = float(psi[grid_.index()[c]]);
    r.direction.x[c] = float(rise(c - 1, c) + rise(c, c + 1));
    r.direction.y[c] = float(rise(c - std::size_t(s.nx), c) + rise(c, c + std::size_t(s.nx)));
  }
  normalise(r.direction);
  spread_outward(s, {&r.direction.x, &r.direction.y, &r.psi}, free_mask(grid_), 4);
  smooth(s, lane, 0.2);
  r.lane_m = std::move(lane);
  return r;
}

}  // namespace witherfield::floor
