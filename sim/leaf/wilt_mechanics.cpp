#include "sim/leaf/wilt_mechanics.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/leaf/contact.hpp"
#include "sim/leaf/leaf_tissue.hpp"
#include "sim/leaf/serial_blas.hpp"
#include "sim/leaf/shell.hpp"
#include "sim/leaf/sparse.hpp"
#include "sim/leaf/step_path.hpp"

namespace witherfield::leaf {
namespace {

constexpr int kRodSegments = 20;

double mean_edge(const std::vector<ShellPatch>& patches) {
  double sum = 0;
  for (const ShellPatch& p : patches)
    for (int i = 0; i < 3; ++i) sum += p.edge_m(i);
  return sum / double(3 * patches.size());
}

double inner(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i], b[i]);
  return sum;
}

}  // namespace

struct WiltMechanics::Impl {
  WiltBody body;
  WiltOptions options;
  std::vector<float> vein;
  RibLayout ribs;
  Shell shell;
  PetioleRod rod;
  Contact contact;
  std::optional<StepPath> path;
  WiltShape shape;
  std::vector<char> held;
  std::optional<BlockMatrix> matrix;
  std::optional<SparseCholesky> factor;
  std::vector<double> mass_kg;    ///< per node
  std::vector<glm::dvec3> gradient, step;
  std::vector<double> rows;
  double convexity = 0;  ///< 0: exact second derivatives .. 1: convex ones
  int successes = 0;     ///< factorisations since it was changed
  double size_m = 0, max_move_m = 0;

  Impl(const WiltBody& b, const WiltOptions& o)
      : body(b), options(o), vein(b.vein.empty() ? vein_field(b) : b.vein),
        shell(make_patches(b.rest.position_m, b.rest.triangles), {}) {
    ribs = lay_ribs(b, shell.patches());
    shell = Shell(shell.patches(), ribs.pieces);
    const int n = int(b.rest.position_m.size());
    const int rod_nodes = b.petiole_m.empty() ? 0 : kRodSegments + 1;
    if (rod_nodes)
      rod = PetioleRod(b.petiole_m, b.petiole_radius_stem_m, b.petiole_radius_blade_m, kRodSegments, n, n + rod_nodes, b.clamp,
                       b.rest.position_m);
    shape.x = b.rest.position_m;
    shape.x.insert(shape.x.end(), rod.rest_m().begin(), rod.rest_m().end());
    shape.frame = rod.rest_frames();
    const std::size_t nodes = shape.x.size() + shape.frame.size();
    held.assign(nodes, 0);
    if (rod_nodes) held[std::size_t(n)] = held[std::size_t(n + rod_nodes)] = 1;  // clamped in the stem
    else for (const int v : b.clamp) held[std::size_t(v)] = 1;
    std::vector<std::pair<int, int>> pairs = shell.couplings(), more = rod.couplings();
    pairs.insert(pairs.end(), more.begin(), more.end());
    matrix.emplace(held, std::move(pairs));
    shell.bind(*matrix);
    path.emplace(b.rest.position_m, shell.patches(), b.clamp, rod_nodes);
    gradient.resize(nodes);
    step.resize(nodes);
    rows.resize(std::size_t(3 * matrix->rows()));
    mass_kg.assign(nodes, 0.0);
    glm::dvec3 lo = shape.x[0], hi = lo;
    for (const glm::dvec3& p : shape.x) lo = glm::min(lo, p), hi = glm::max(hi, p);
    size_m = glm::length(hi - lo);
    max_move_m = 0.2 * size_m;
    set_contact();
    const std::vector<double> full(std::size_t(std::max(n, rod_nodes)), 1.0);
    set_water(std::span(full).first(std::size_t(n)), std::span(full).first(std::size_t(rod_nodes)));
    if (b.rest_carries_weight) carry_weight();
  }

  void set_contact() {
    const double gap = options.solver.contact_gap * mean_edge(shell.patches());
    if (gap <= 0) return;
    std::vector<double> radius(body.rest.position_m.size(), gap / 2);
    for (int k = 0; k < rod.nodes(); ++k) radius.push_back(rod.radius_m(k) + gap / 2);
    contact = Contact(shape.x, std::move(radius), 2.5 * gap / std::max(options.solver.contact_gap, 0.5));
  }

  void set_water(std::span<const double> blade, std::span<const double> petiole) {
    const WiltTissueOptions& t = options.tissue;
    const auto& patches = shell.patches();
    std::vector<ShellMaterial> material(patches.size());
    std::fill(mass_kg.begin(), mass_kg.end(), 0.0);
    for (std::size_t k = 0; k < patches.size(); ++k) {
      const auto& c = patches[k].corner;
      double w = 0, v = 0;
      for (const int i : c) {
        w += blade[std::size_t(i)] / 3;
        v += vein[std::size_t(i)] / 3;
        mass_kg[std::size_t(i)] +=
            patches[k].area_m2 / 3 * (t.dry_mass_kg_m2 + options.water.blade_water_kg_m2 * blade[std::size_t(i)]);
      }
      material[k] = {blade_membrane_MPa(t, w) * 1e6, blade_bending_MPa(t, w) * 1e6, thickness_m(t, w), t.poisson,
                     shrink_strain(t, w, v), shrink_curvature_1_m(t, w, v), vein_modulus_MPa(t, w) * 1e6, t.compression_share,
                     t.vein_turgid_MPa * 1e6, shrink_strain(t, w, 1)};  // fibres carry the length of a vein, turgid or not (Vincent 1982: they carry it in grasses)
    }
    for (const RibPiece& r : ribs.pieces) {
      const auto& c = patches[std::size_t(r.triangle)].corner;
      const double mass = options.water.petiole_water_kg_m3 * std::numbers::pi * r.radius_m * r.radius_m * r.length_m;
      for (const int i : c) mass_kg[std::size_t(i)] += mass / 3 * blade[std::size_t(i)];
    }
    shell.set_material(material);
    std::vector<double> modulus(std::size_t(rod.segments()));
    for (std::size_t s = 0; s < modulus.size(); ++s) {
      const double w = (petiole[s] + petiole[s + 1]) / 2, r = (rod.radius_m(int(s)) + rod.radius_m(int(s) + 1)) / 2;
      modulus[s] = petiole_modulus_MPa(t, w) * 1e6;
      const double volume = std::numbers::pi * r * r * rod.segment_m(int(s));
      for (const std::size_t k : {s, s + 1})
        mass_kg[body.rest.position_m.size() + k] += volume / 2 * options.water.petiole_water_kg_m3 * w;
    }
    rod.set_modulus(modulus);
  }

  double weight_energy(const WiltShape& s) const {
    double sum = 0;
    for (std::size_t i = 0; i < s.x.size(); ++i) sum += mass_kg[i] * s.x[i].z;
    return sum * options.solver.gravity_m_s2;
  }
  double weight_norm() const {
    double sum = 0;
    for (std::size_t i = 0; i < mass_kg.size(); ++i)
      if (!held[i]) sum += mass_kg[i] * mass_kg[i];
    return std::sqrt(sum) * options.solver.gravity_m_s2;
  }

  double energy_scale() const {
    double mass = 0;
    for (const double m : mass_kg) mass += m;
    return std::max(mass * options.solver.gravity_m_s2 * size_m, 1e-12);
  }

  double energy(const WiltShape& s) const {
    return shell.energy(s.x) + rod.energy(s) + contact.energy(s.x) + weight_energy(s);
  }

  double assemble(double exactness) {
    std::fill(gradient.begin(), gradient.end(), glm::dvec3(0.0));
    matrix->set_zero();
    double sum = shell.assemble(shape.x, gradient, *matrix, exactness);
    sum += rod.assemble(shape, gradient, *matrix, exactness);
    sum += contact.assemble(shape.x, gradient, *matrix);
    for (std::size_t i = 0; i < shape.x.size(); ++i) gradient[i].z += mass_kg[i] * options.solver.gravity_m_s2;
    return sum + weight_energy(shape);
  }

  bool factorise() {
    try {
      if (factor) factor->refactor(matrix->scalar());
      else factor.emplace(matrix->scalar(), Factor::blocked);
      return true;
    } catch (const SolverFailure&) {
      return false;
    }
  }

  /// step = -H^-1 gradient on the free nodes.
  void newton_step() {
    matrix->gather(gradient, rows);
    factor->solve(rows, rows);
    matrix->scatter(rows, step);
    for (glm::dvec3& d : step) d = -d;
  }

  /// Factors second derivatives as exact as they can be while positive definite: near buckling the convex ones are far too stiff.
  /// `convexity` runs over 0, 1/27, 1/9, 1/3, 1: one down after two successes, one up after each failure.
  double assemble_and_factorise() {
    constexpr double kLeast = 1.0 / 27;
    if (successes >= 2) {
      convexity = convexity > kLeast * 1.5 ? convexity / 3 : 0;
      successes = 0;
    }
    for (;;) {
      const double e = assemble(1 - convexity);
      if (factorise()) {
        ++successes;
        return e;
      }
      successes = 0;
      if (convexity >= 1) break;
      convexity = convexity == 0 ? kLeast : std::min(1.0, 3 * convexity);
    }
    double shift = 1e-12 * matrix->mean_diagonal();  // rounding alone has made the matrix indefinite
    for (int attempt = 0; attempt < 9; ++attempt, shift *= 30) {
      const double e = assemble(0);
      matrix->add_to_diagonal(shift);
      if (factorise()) return e;
    }
    throw SolverFailure("WiltMechanics: the stiffness matrix cannot be made positive definite");
  }

  /// The natural pose as the shape that the unloaded leaf takes on under its weight: the load goes into the rest shape. With
  /// energies quadratic in their strains the gradient at rest becomes K u - weight, exactly zero for K u = weight.
  void carry_weight() {
    const SerialBlas serial;
    const double reference = std::max(weight_norm(), 1e-12);
    for (int k = 0; k < 20; ++k) {  // once would do but for rounding and the stiffness of what is now under load
      assemble(0);
      if (free_norm() < 1e-7 * reference) break;
      if (!factorise()) throw SolverFailure("WiltMechanics: the stiffness matrix of the natural pose is not positive definite");
      newton_step();
      shell.preload(shape.x, step);
      rod.preload(shape, step);
    }
  }

  double free_norm() const {
    double sum = 0;
    for (std::size_t i = 0; i < gradient.size(); ++i)
      if (!held[i]) sum += glm::dot(gradient[i], gradient[i]);
    return std::sqrt(sum);
  }

  RelaxReport relax() {
    const SerialBlas serial;
    RelaxReport report;
    for (;; ++report.iterations) {
      const double before = assemble_and_factorise();
      if (report.energy_J.empty()) report.energy_J.push_back(before);
      if (!std::isfinite(free_norm()) || !std::isfinite(before))
        throw SolverFailure("WiltMechanics: the energy or a force is not finite after " + std::to_string(report.iterations) +
                            " steps");
      newton_step();
      // With nearly convex second derivatives the steps are too short: there is more to gain than one of them would.
      report.residual = -inner(gradient, step) / energy_scale() * (convexity > 0.2 ? 10 : 1);
      report.converged = report.residual < options.solver.tolerance;
      if (report.converged || report.iterations >= options.solver.max_iterations) break;
      if (!search(before, report)) break;
    }
    report.touching = contact.touching(shape.x);
    return report;
  }

  /// Moves along `step` so far that the energy falls enough (Armijo); false when it cannot fall any more.
  bool search(double before, RelaxReport& report) {
    double longest = 0, turn = 0;
    for (std::size_t i = 0; i < step.size(); ++i)
      (i < shape.x.size() ? longest : turn) = std::max(i < shape.x.size() ? longest : turn, glm::length(step[i]));
    double share = std::min({1.0, max_move_m / std::max(longest, 1e-300), 1.0 / std::max(turn, 1e-300)});
    for (glm::dvec3& d : step) d *= share;
    const double slope = inner(gradient, step);
    share = 1;
    for (int k = 0; k < 40; ++k, share /= 2) {
      WiltShape trial = path->at(shape, step, share);
      if (!contact.allows(shape.x, trial.x)) continue;
      const double after = energy(trial);
      if (after <= before + 1e-4 * share * slope) {
        shape = std::move(trial);
        report.energy_J.push_back(after);
        return true;
      }
    }
    return false;
  }
};

WiltMechanics::WiltMechanics(const WiltBody& body, const WiltOptions& options) {
  validate(body);
  validate(options);
  impl_ = std::make_unique<Impl>(body, options);
}
WiltMechanics::~WiltMechanics() = default;
WiltMechanics::WiltMechanics(WiltMechanics&&) noexcept = default;
WiltMechanics& WiltMechanics::operator=(WiltMechanics&&) noexcept = default;

void WiltMechanics::set_water(std::span<const double> blade, std::span<const double> petiole) {
  if (blade.size() != impl_->body.rest.position_m.size() || petiole.size() != std::size_t(impl_->rod.nodes()))
    throw InvalidInput("WiltMechanics::set_water: " + std::to_string(blade.size()) + " + " + std::to_string(petiole.size()) +
                       " values for " + std::to_string(impl_->body.rest.position_m.size()) + " vertices and " +
                       std::to_string(impl_->rod.nodes()) + " nodes");
  impl_->set_water(blade, petiole);
}
RelaxReport WiltMechanics::relax() { return impl_->relax(); }
const WiltShape& WiltMechanics::shape() const { return impl_->shape; }
const RibLayout& WiltMechanics::ribs() const { return impl_->ribs; }
int WiltMechanics::rod_nodes() const { return impl_->rod.nodes(); }
double WiltMechanics::rod_radius_m(int node) const { return impl_->rod.radius_m(node); }
std::vector<double> WiltMechanics::von_mises_MPa() const { return impl_->shell.von_mises_MPa(impl_->shape.x); }
std::vector<double> WiltMechanics::rod_stress_MPa() const { return impl_->rod.stress_MPa(impl_->shape); }
const std::vector<float>& WiltMechanics::vein() const { return impl_->vein; }
double WiltMechanics::energy_J() const { return impl_->energy(impl_->shape); }
std::vector<glm::dvec3> WiltMechanics::forces_N() const {
  impl_->assemble(0);
  std::vector<glm::dvec3> f(impl_->gradient);
  for (glm::dvec3& v : f) v = -v;
  return f;
}

}  // namespace witherfield::leaf
