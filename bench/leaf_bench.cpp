// Deformation of a leaf-like sheet by handles (5 fixed, 5 moved): 2,601 vertices (the paper's case has 2,600) and 99,856.
//
//   leaf_bench                                     all; ends with tables
//   leaf_bench --benchmark_filter=linear           the paper's linear edit, against Eigen, CHOLMOD
//   leaf_bench --benchmark_filter=rotation         rotation-aware, against CGAL
//
// All contenders run in turn within every round, so that whatever else the machine does falls on all alike. One thread.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

#include "bench/deform_peers.hpp"
#include "sim/core/parallel.hpp"
#include "sim/leaf/arap.hpp"
#include "sim/leaf/cotangent.hpp"
#include "sim/leaf/editor.hpp"
#include "sim/leaf/laplacian_edit.hpp"
#include "sim/leaf/leaf_area.hpp"
#include "tests/leaf/shapes.hpp"

namespace witherfield::bench {
namespace {

using namespace leaf;
using Clock = std::chrono::steady_clock;

constexpr int kSides[] = {51, 316};

double seconds(const auto& work) {
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> v) {
  if (v.empty()) return std::nan("");
  std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
  return v[v.size() / 2];
}

struct Row {
  std::vector<double> prepare, drag, energy;  ///< seconds; energy over that of CGAL SRE_ARAP at the same drag
  double difference_m = 0;                    ///< largest, from the first contender's positions; the sheet has size 2
};
std::map<int, std::vector<std::pair<std::string, Row>>>& linear_results() {
  static std::map<int, std::vector<std::pair<std::string, Row>>> all;
  return all;
}
std::map<int, std::vector<std::pair<std::string, Row>>>& rotation_results() {
  static std::map<int, std::vector<std::pair<std::string, Row>>> all;
  return all;
}

DeformInput input_of(const Surface& s, int side) { return {s.position_m, s.triangles, test::ten_handles(side), 10}; }

/// One side is lifted and drawn in, a bit further each time.
std::vector<glm::dvec3> curled(const DeformInput& input, double share) {
  std::vector<glm::dvec3> target;
  for (std::size_t h = 0; h < input.handle.size(); ++h) {
    target.push_back(input.position[std::size_t(input.handle[h])]);
    if (h >= 5) target.back() += share * glm::dvec3(-0.7, 0.05 * double(h - 5), 1.1);
  }
  return target;
}

double largest_difference(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
  double d = 0;
  for (std::size_t i = 0; i < a.size(); ++i) d = std::max(d, glm::distance(a[i], b[i]));
  return d;
}

/// Order and factor, answer of a fixed handle set, full solve, drag.
void linear_edit(benchmark::State& state) {
  const ThreadLimit limit(1);
  const int side = int(state.range(0));
  const Surface sheet = test::sheet(side);
  const DeformInput input = input_of(sheet, side);
  const SparseMatrix l = cotangent_laplacian(sheet);
  const std::vector<double> weight(input.handle.size(), input.weight);
  std::vector<std::pair<std::string, std::unique_ptr<DeformPeer>>> peers;
  peers.emplace_back("Eigen SimplicialLLT, normal equations", eigen_llt(input));
  peers.emplace_back("CHOLMOD simplicial, normal equations", cholmod_simplicial(input));
  peers.emplace_back("CHOLMOD supernodal, normal equations", cholmod_supernodal(input));
  Row response, full;
  std::vector<Row> rows(peers.size());
  std::vector<glm::dvec3> ours(sheet.position_m.size()), solved = ours;
  constexpr int kDrags = 10;
  for (auto _ : state) {
    std::optional<LaplaceSolver> solver;
    std::optional<LaplacianEdit> edit;
    full.prepare.push_back(seconds([&] { solver.emplace(l); }));
    response.prepare.push_back(seconds([&] { edit.emplace(handle_columns(*solver, input.handle), weight); }));
    double first = 0;
    for (int k = 1; k <= kDrags; ++k) {
      const auto target = curled(input, double(k) / kDrags);
      response.drag.push_back(seconds([&] { edit->drag(input.position, target, ours); }));
      full.drag.push_back(seconds([&] { edit->solve(*solver, input.position, target, solved); }));
      first += response.drag.back();
    }
    state.SetIterationTime(first / kDrags);
    full.difference_m = std::max(full.difference_m, largest_difference(ours, solved));
    for (std::size_t p = 0; p < peers.size(); ++p) {
      rows[p].prepare.push_back(seconds([&] { peers[p].second->prepare(); }));
      for (int k = 1; k <= kDrags; ++k) {
        const auto target = curled(input, double(k) / kDrags);
        rows[p].drag.push_back(seconds([&] { peers[p].second->drag(target); }));
      }
      rows[p].difference_m = std::max(rows[p].difference_m, largest_difference(ours, peers[p].second->positions()));
    }
  }
  auto& table = linear_results()[side];
  table.emplace_back("witherfield, answer of fixed handles", response);
  table.emplace_back("witherfield, full solve", full);
  for (std::size_t p = 0; p < peers.size(); ++p) table.emplace_back(peers[p].first, rows[p]);
}

/// A curl in twenty drags, each going on from the last.
void rotation_aware_edit(benchmark::State& state) {
  const ThreadLimit limit(1);
  const int side = int(state.range(0));
  const Surface sheet = test::sheet(side);
  const DeformInput input = input_of(sheet, side);
  std::vector<Handle> handles;
  for (const int h : input.handle) handles.push_back({h, input.weight});
  const LaplaceSolver solver(cotangent_laplacian(sheet));
  const ArapEdit judge(solver, sheet.position_m, surface_area_m2(sheet), 0.02);  // the same alpha as CGAL's default
  const std::vector<int> iterations{2, 3, 5};
  std::vector<std::pair<std::string, std::unique_ptr<DeformPeer>>> peers;
  peers.emplace_back("CGAL SRE_ARAP, default (5 iterations)", cgal_sre_arap(input));
  peers.emplace_back("CGAL ORIGINAL_ARAP, default (5 iterations)", cgal_original_arap(input));
  std::vector<Row> own(iterations.size()), rows(peers.size());
  constexpr int kDrags = 20;
  for (auto _ : state) {
    std::vector<LeafEditor> editors;
    for (std::size_t e = 0; e < iterations.size(); ++e) {
      EditOptions o;
      o.max_iterations = iterations[e];
      o.tolerance = 1e-14;
      own[e].prepare.push_back(seconds([&] {
        editors.emplace_back(sheet, o);
        editors.back().set_handles(handles);
      }));
    }
    for (std::size_t p = 0; p < peers.size(); ++p) rows[p].prepare.push_back(seconds([&] { peers[p].second->prepare(); }));
    for (int k = 1; k <= kDrags; ++k) {
      const auto target = curled(input, double(k) / kDrags);
      for (std::size_t p = 0; p < peers.size(); ++p) rows[p].drag.push_back(seconds([&] { peers[p].second->drag(target); }));
      const bool judged = side < 100 || k % 5 == 0;
      const double reference = judged ? judge.energy(peers[0].second->positions()) : 1;
      if (judged) rows[1].energy.push_back(judge.energy(peers[1].second->positions()) / reference);
      for (std::size_t e = 0; e < editors.size(); ++e) {
        own[e].drag.push_back(seconds([&] { editors[e].drag(target); }));
        if (judged) own[e].energy.push_back(judge.energy(editors[e].positions()) / reference);
      }
    }
    state.SetIterationTime(median(own[1].drag));
  }
  auto& table = rotation_results()[side];
  for (std::size_t e = 0; e < own.size(); ++e)
    table.emplace_back("witherfield, " + std::to_string(iterations[e]) + " iterations", own[e]);
  rows[0].energy.push_back(1);
  for (std::size_t p = 0; p < peers.size(); ++p) table.emplace_back(peers[p].first, rows[p]);
}

void print_tables() {
  for (const auto& [side, table] : linear_results()) {
    std::printf("\nlinear edit, %d vertices%27s %12s %14s\n", side * side, "set-up ms", "drag ms", "difference");
    for (const auto& [who, row] : table)
      std::printf("%-44s %9.2f %12.4f %14.1e\n", who.c_str(), 1e3 * median(row.prepare), 1e3 * median(row.drag), row.difference_m);
    std::printf("(set-up of the first row comes on top of the second's, once for each set of handles)\n");
  }
  for (const auto& [side, table] : rotation_results()) {
    const double reference = median(table[table.size() - 2].second.drag);
    std::printf("\nrotation-aware edit, %d vertices%20s %10s %10s %18s %18s\n", side * side, "set-up ms", "drag ms", "faster",
                "energy, median", "energy, worst");
    for (const auto& [who, row] : table)
      std::printf("%-44s %9.2f %10.3f %10.2f %18.4f %18.4f\n", who.c_str(), 1e3 * median(row.prepare), 1e3 * median(row.drag),
                  reference / median(row.drag), median(row.energy), *std::max_element(row.energy.begin(), row.energy.end()));
    std::printf("(faster than, and energy over, CGAL SRE_ARAP's at the same drag)\n");
  }
}

BENCHMARK(linear_edit)->ArgName("side")->Arg(kSides[0])->UseManualTime()->Iterations(15)->Unit(benchmark::kMillisecond);
BENCHMARK(linear_edit)->ArgName("side")->Arg(kSides[1])->UseManualTime()->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK(rotation_aware_edit)->ArgName("side")->Arg(kSides[0])->UseManualTime()->Iterations(7)->Unit(benchmark::kMillisecond);
BENCHMARK(rotation_aware_edit)->ArgName("side")->Arg(kSides[1])->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace witherfield::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  witherfield::bench::print_tables();
  benchmark::Shutdown();
}
