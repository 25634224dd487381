#include "sim/leaf/leaf_water.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <queue>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/leaf/cotangent.hpp"
#include "sim/leaf/leaf_tissue.hpp"
#include "sim/leaf/vein_ribs.hpp"

namespace witherfield::leaf {
namespace {

/// Distance from the margin along the edges of the mesh (Dijkstra), m.
std::vector<double> margin_distance_m(const Surface& s) {
  const std::size_t n = s.position_m.size();
  std::vector<std::pair<int, int>> edges;
  for (const auto& t : s.triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.emplace_back(std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  std::vector<double> distance(n, 1e300);
  std::vector<std::vector<int>> next(n);
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto [a, b] = edges[k];
    if (k > 0 && edges[k - 1] == edges[k]) continue;
    next[std::size_t(a)].push_back(b);
    next[std::size_t(b)].push_back(a);
    if (k + 1 < edges.size() && edges[k + 1] == edges[k]) continue;
    for (const int v : {a, b}) {  // an edge of one triangle: on the margin
      distance[std::size_t(v)] = 0;
      queue.emplace(0.0, v);
    }
  }
  while (!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d > distance[std::size_t(v)]) continue;
    for (const int u : next[std::size_t(v)]) {
      const double to = d + glm::distance(s.position_m[std::size_t(u)], s.position_m[std::size_t(v)]);
      if (to >= distance[std::size_t(u)]) continue;
      distance[std::size_t(u)] = to;
      queue.emplace(to, u);
    }
  }
  return distance;
}

/// Conductances between vertices, kg/s. The blade: W0 D w_ij / 2 with the cotangent weights. Veins: a piece of length l and section s
/// along d in a triangle with shape gradients g conducts -k s l (g_i . d) (g_j . d) between two corners (all of k s / |ij| when it runs
/// along an edge, as main and side veins do). Negative ones are set to 0: water must not flow from dry to wet.
std::vector<Entry> conductances(const WiltBody& body, const WiltWaterOptions& o) {
  const SparseMatrix l = cotangent_laplacian(body.rest.position_m, body.rest.triangles);
  std::vector<Entry> g;
  const auto add = [&](int i, int j, double value) {
    if (value > 0) g.push_back({std::min(i, j), std::max(i, j), value});
  };
  for (int i = 0; i < l.rows(); ++i)
    for (int k = l.row_start[std::size_t(i)]; k < l.row_start[std::size_t(i) + 1]; ++k)
      if (const int j = l.column[std::size_t(k)]; j > i)
        add(i, j, -l.value[std::size_t(k)] * o.diffusivity_blade_m2_s * o.blade_water_kg_m2 / 2);
  const std::vector<ShellPatch> patches = make_patches(body.rest.position_m, body.rest.triangles);
  for (const RibPiece& r : lay_ribs(body, patches).pieces) {
    const ShellPatch& p = patches[std::size_t(r.triangle)];
    const double flow = o.vein_conductivity_kg_m_s * std::numbers::pi * r.radius_m * r.radius_m * r.length_m;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      add(p.corner[i], p.corner[j], -flow * glm::dot(p.gradient[i], r.direction) * glm::dot(p.gradient[j], r.direction));
    }
  }
  return g;
}

}  // namespace

double WaterBalance::error(double start_kg) const {
  return std::abs(in_kg - out_kg - stored_kg) / std::max({in_kg, out_kg, std::abs(stored_kg), start_kg});
}

struct LeafWater::Impl {
  WiltOptions options;
  Curve supply;
  std::size_t vertices = 0;
  bool fine_veins = false;               ///< finer than the mesh: they feed every vertex of the inlet
  std::vector<double> water, capacity_kg, transpiring_kg_s, entry_kg_s;
  struct Link {
    int a, b;
    double kg_s;                         ///< with turgor
    int slot_ab, slot_ba;                ///< in `system`
  };
  std::vector<Link> links;
  SparseMatrix system;
  std::vector<int> diagonal;
  std::optional<SparseCholesky> factor;
  WaterBalance balance;
  double start_kg = 0, now_s = 0;

  Impl(const WiltBody& body, const std::vector<glm::dvec3>& rod, const std::vector<double>& radius, const WiltOptions& o)
      : options(o), vertices(body.rest.position_m.size()) {
    const WiltWaterOptions& w = o.water;
    supply = w.supply_curve.empty() ? Curve({{0.0, 1.0}, {0.5, 0.0}}, "wilt.supply_curve")
                                    : Curve(w.supply_curve, "wilt.supply_curve");
    const std::vector<double> area = vertex_areas(body.rest.position_m, body.rest.triangles);
    const std::vector<double> margin = margin_distance_m(body.rest);
    for (std::size_t i = 0; i < vertices; ++i) {
      capacity_kg.push_back(area[i] * w.blade_water_kg_m2);
      transpiring_kg_s.push_back(area[i] * w.transpiration_kg_m2_s *
                                 (1 + w.margin_gain * std::exp(-margin[i] / w.margin_width_m)));
    }
    std::vector<Entry> g = conductances(body, w);
    entry_kg_s.assign(vertices + rod.size(), 0.0);
    fine_veins = !body.inlet.empty();
    const std::vector<int>& fed = fine_veins ? body.inlet : body.clamp;
    double fed_m2 = 0;
    for (const int v : fed) fed_m2 += area[std::size_t(v)];
    std::vector<Entry> shares;  // row = vertex; value: of the water
    for (const int v : fed) shares.push_back({v, 0, fine_veins ? area[std::size_t(v)] / fed_m2 : 1.0 / double(fed.size())});
    if (rod.empty())
      for (const Entry& s : shares) entry_kg_s[std::size_t(s.row)] = w.petiole_conductance_kg_s * s.value;
    else
      add_petiole(shares, rod, radius, g);
    finish(g);
  }

  void add_petiole(const std::vector<Entry>& fed, const std::vector<glm::dvec3>& rod, const std::vector<double>& radius,
                   std::vector<Entry>& g) {
    const WiltWaterOptions& w = options.water;
    // In series: half of the resistance where the water enters the petiole, half along it; a free way into the blade, where the
    // curves resist, or as much again where veins do that the mesh does not show (estimate; the leaf is a substantial part of
    // a plant's resistance: Sack & Holbrook 2006).
    const double along = 2 * w.petiole_conductance_kg_s * double(rod.size() - 1);
    for (std::size_t k = 0; k < rod.size(); ++k) {
      double length = 0;
      if (k > 0) length += glm::distance(rod[k], rod[k - 1]) / 2;
      if (k + 1 < rod.size()) length += glm::distance(rod[k], rod[k + 1]) / 2;
      capacity_kg.push_back(std::numbers::pi * radius[k] * radius[k] * length * w.petiole_water_kg_m3);
      transpiring_kg_s.push_back(0.0);  // a thick cuticle and little surface
      if (k > 0) g.push_back({int(vertices + k - 1), int(vertices + k), along});
    }
    entry_kg_s[vertices] = 2 * w.petiole_conductance_kg_s;
    const int end = int(vertices + rod.size() - 1);
    for (const Entry& f : fed) g.push_back({f.row, end, w.petiole_conductance_kg_s * (fine_veins ? f.value : 1e3)});
  }

  void finish(const std::vector<Entry>& g) {
    std::vector<Entry> entries;
    for (const Entry& e : g)
      entries.insert(entries.end(), {{e.row, e.column, 0.0}, {e.column, e.row, 0.0}});
    for (int i = 0; i < int(capacity_kg.size()); ++i) entries.push_back({i, i, 0.0});
    system = assemble(int(capacity_kg.size()), std::move(entries));
    for (const Entry& e : g)
      links.push_back({e.row, e.column, e.value, system.find(e.row, e.column), system.find(e.column, e.row)});
    for (int i = 0; i < system.rows(); ++i) diagonal.push_back(system.find(i, i));
    water.assign(capacity_kg.size(), 1.0);
    for (const double c : capacity_kg) start_kg += c;
  }

  double stored() const {
    double sum = 0;
    for (std::size_t i = 0; i < water.size(); ++i) sum += capacity_kg[i] * (water[i] - 1);
    return sum;
  }

  void step(double dt) {
    const double open = supply((now_s + dt) / 3600);
    std::vector<double> rhs(water.size()), loss(water.size());
    std::fill(system.value.begin(), system.value.end(), 0.0);
    for (const Link& l : links) {
      const bool in_blade = std::size_t(l.b) < vertices, into_blade = fine_veins && std::size_t(l.a) < vertices;
      const double wet = water[std::size_t(l.a)];
      const double flow = dt * l.kg_s * (in_blade ? conductance((wet + water[std::size_t(l.b)]) / 2) : into_blade ? conductance(wet) : 1.0);
      system.value[std::size_t(l.slot_ab)] -= flow;
      system.value[std::size_t(l.slot_ba)] -= flow;
      system.value[std::size_t(diagonal[std::size_t(l.a)])] += flow;
      system.value[std::size_t(diagonal[std::size_t(l.b)])] += flow;
    }
    for (std::size_t i = 0; i < water.size(); ++i) {
      const double w = std::max(water[i], 1e-12);
      loss[i] = transpiring_kg_s[i] * transpiration_share(options.tissue, options.water.cuticular_share, w) / w;
      system.value[std::size_t(diagonal[i])] += capacity_kg[i] + dt * (loss[i] + open * entry_kg_s[i]);
      rhs[i] = capacity_kg[i] * water[i] + dt * open * entry_kg_s[i];
    }
    if (factor) factor->refactor(system);
    else factor.emplace(system, Factor::sparse);
    factor->solve(rhs, water);
    refine(rhs);
    for (std::size_t i = 0; i < water.size(); ++i) {
      if (!std::isfinite(water[i])) throw SolverFailure("LeafWater: water at node " + std::to_string(i) + " is not finite");
      balance.out_kg += dt * loss[i] * water[i];
      balance.in_kg += dt * open * entry_kg_s[i] * (1 - water[i]);
    }
    now_s += dt;
    balance.stored_kg = stored();
  }

  double conductance(double w) const {
    return 1 - options.water.conductance_loss * (1 - turgor_share(options.tissue, w));
  }

  /// One step of iterative refinement: veins conduct a thousand times better than the blade, the balance is to hold anyway.
  void refine(const std::vector<double>& rhs) {
    std::vector<double> residual(water.size());
    multiply(system, water, residual);
    for (std::size_t i = 0; i < rhs.size(); ++i) residual[i] = rhs[i] - residual[i];
    factor->solve(residual, residual);
    for (std::size_t i = 0; i < rhs.size(); ++i) water[i] += residual[i];
  }
};

LeafWater::LeafWater(const WiltBody& body, const std::vector<glm::dvec3>& rod, const std::vector<double>& radius,
                     const WiltOptions& options) {
  validate(body);
  validate(options);
  if (rod.size() != radius.size() || rod.size() == 1)
    throw InvalidInput("LeafWater: two nodes of the petiole or more, and one radius per node, are needed");
  impl_ = std::make_unique<Impl>(body, rod, radius, options);
}
LeafWater::~LeafWater() = default;
LeafWater::LeafWater(LeafWater&&) noexcept = default;
LeafWater& LeafWater::operator=(LeafWater&&) noexcept = default;

void LeafWater::advance_to(double hours) {
  const double span = hours * 3600 - impl_->now_s, longest = 3600 / impl_->options.water.steps_per_hour;
  if (span < -1e-6) throw InvalidInput("LeafWater::advance_to: " + std::to_string(hours) + " h lies in the past");
  const int steps = int(std::ceil(span / longest - 1e-9));
  for (int k = 0; k < steps; ++k) impl_->step(span / steps);
}
double LeafWater::now_hours() const { return impl_->now_s / 3600; }
std::span<const double> LeafWater::blade() const { return std::span(impl_->water).first(impl_->vertices); }
std::span<const double> LeafWater::petiole() const { return std::span(impl_->water).subspan(impl_->vertices); }
const WaterBalance& LeafWater::balance() const { return impl_->balance; }
double LeafWater::start_kg() const { return impl_->start_kg; }
double LeafWater::supply(double hours) const { return std::clamp(impl_->supply(hours), 0.0, 1.0); }
double LeafWater::mean_blade() const {
  double sum = 0, all = 0;
  for (std::size_t i = 0; i < impl_->vertices; ++i) {
    sum += impl_->capacity_kg[i] * impl_->water[i];
    all += impl_->capacity_kg[i];
  }
  return sum / all;
}

}  // namespace witherfield::leaf
