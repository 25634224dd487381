// Loop subdivision of a closed torus of 1,024 faces with 200 edges flipped, five steps: 1,048,576 faces;
// against CGAL, OpenMesh, OpenSubdiv and VTK, with and without creases.
//
//   subdivision_bench                                    all; ends with tables
//   subdivision_bench --benchmark_filter=again           evaluation of moving control points only
//
// All contenders run in turn within every round, so that whatever else the machine does falls on all alike.
// Before each, all free memory is given back to the system ("fresh") or not ("reused": the best that the
// peers' allocations can do, too). The peers use one thread.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <optional>

#include "bench/subdivision_peers.hpp"
#include "sim/core/parallel.hpp"
#include "sim/core/raw_buffer.hpp"
#include "tests/fruit/mesh_fixtures.hpp"

namespace witherfield::bench {
namespace {

using namespace fruit;
using Clock = std::chrono::steady_clock;

constexpr int kSteps = 5;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> v) {
  if (v.empty()) return std::nan("");
  std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
  return v[v.size() / 2];
}

/// Times in seconds: results()[table][contender].
std::map<std::string, std::map<std::string, std::vector<double>>>& results() {
  static std::map<std::string, std::map<std::string, std::vector<double>>> all;
  return all;
}

ControlMesh control_mesh(bool creased) {
  ControlMesh m = fixtures::torus(32, 16, 200);
  if (creased) fixtures::tag(m, 27);
  return m;
}

LoopInput input_of(const ControlMesh& m) {
  LoopInput in;
  for (const auto& p : m.position_m) in.position.push_back({float(p.x), float(p.y), float(p.z)});
  in.triangles = m.triangles;
  in.creases = m.crease_edges;
  in.corners = m.sharp_vertices;
  in.steps = kSteps;
  return in;
}

/// Ours: positions as floats into memory of the caller.
struct Ours {
  explicit Ours(const ControlMesh& m) : mesh(m), control(m.position_m.begin(), m.position_m.end()) {}

  std::span<glm::vec3> positions(std::size_t vertices) {
    buffer.require(3 * vertices);
    return {reinterpret_cast<glm::vec3*>(buffer.data()), vertices};
  }
  void refine() {
    refinement = refinement ? Refinement(mesh, Scheme::hoppe1994, kSteps, std::move(*refinement))
                            : Refinement(mesh, Scheme::hoppe1994, kSteps);
    refinement->evaluate(control, positions(refinement->vertices()));
  }
  void forget() {
    refinement.reset();
    buffer = RawBuffer();
  }
  LoopSums sums() {
    const auto p = positions(refinement->vertices());
    return sums_of(
        p.size(), refinement->faces(),
        [&](std::size_t v) {
          return std::array<double, 3>{p[v].x, p[v].y, p[v].z};
        },
        [&](std::size_t f) {
          const auto& t = refinement->triangles()[f];
          return std::array{std::size_t(t[0]), std::size_t(t[1]), std::size_t(t[2])};
        });
  }

  ControlMesh mesh;
  std::vector<glm::vec3> control;
  std::optional<Refinement> refinement;
  RawBuffer buffer;
};

/// Hoppe's masks of creases with other than regular ends differ from OpenSubdiv's: nearly the same surface,
/// then.
bool same(const LoopSums& a, const LoopSums& b, double tolerance) {
  return a.vertices == b.vertices && a.faces == b.faces && std::abs(a.area / b.area - 1) < tolerance &&
         std::abs(a.square / b.square - 1) < tolerance;
}

/// Topology and positions from the control mesh. Arguments: creases, fresh memory.
void refine_in_turn(benchmark::State& state) {
  const bool creased = state.range(0) != 0, fresh = state.range(1) != 0;
  const ControlMesh mesh = control_mesh(creased);
  const LoopInput input = input_of(mesh);
  std::vector<std::pair<std::string, std::unique_ptr<LoopPeer>>> peers;
  peers.emplace_back("OpenSubdiv RefineUniform + PrimvarRefiner", opensubdiv_loop(input));
  if (!creased) {
    peers.emplace_back("CGAL Loop, Surface_mesh<float>", cgal_loop_float(input));
    peers.emplace_back("CGAL Loop, Surface_mesh<double>", cgal_loop_double(input));
    peers.emplace_back("OpenMesh LoopT, float", openmesh_loop_float(input));
    peers.emplace_back("OpenMesh LoopT, double", openmesh_loop_double(input));
    peers.emplace_back("vtkLoopSubdivisionFilter", vtk_loop(input));
  }
  auto& table =
      results()[std::string(creased ? "creased" : "smooth") + (fresh ? ", fresh memory" : ", reused memory")];
  Ours ours(mesh);
  const auto own_turn = [&](int threads) {
    const ThreadLimit limit(threads);
    if (fresh) {
      ours.forget();
      malloc_trim(0);
    }
    const auto start = Clock::now();
    ours.refine();
    const double t = seconds_since(start);
    table["witherfield, " + std::to_string(threads) + (threads == 1 ? " thread" : " threads")].push_back(t);
    return t;
  };
  for (auto _ : state) {
    state.SetIterationTime(own_turn(1));
    own_turn(2);
    const LoopSums own = ours.sums();
    for (auto& [name, peer] : peers) {
      peer->prepare();
      if (fresh) malloc_trim(0);
      const auto start = Clock::now();
      peer->refine();
      table[name].push_back(seconds_since(start));
      if (!same(own, peer->sums(), creased ? 2e-3 : 1e-5))
        state.SkipWithError((name + " gives another surface").c_str());
      if (fresh) peer->prepare();
    }
  }
}

/// Positions alone, again and again, for control points that move.
void evaluate_again(benchmark::State& state) {
  const ControlMesh mesh = control_mesh(state.range(0) != 0);
  LoopInput input = input_of(mesh);
  auto& table = results()[state.range(0) ? "creased, evaluation again" : "smooth, evaluation again"];
  const auto start = Clock::now();
  OpenSubdivStencils stencils(input);
  table["OpenSubdiv stencil table, built once"].push_back(seconds_since(start));
  state.counters["stencils_MB"] = stencils.megabytes();
  Ours ours(mesh);
  ours.refine();
  const auto out = ours.positions(ours.refinement->vertices());
  std::vector<glm::dvec3> control(mesh.position_m), refined(out.size());
  float frame = 0;
  for (auto _ : state) {
    frame += 0.01f;
    for (std::size_t v = 0; v < input.position.size(); ++v) {
      input.position[v][2] = ours.control[v].z =
          float(mesh.position_m[v].z) + 0.1f * std::sin(frame + float(v));
      control[v].z = double(ours.control[v].z);
    }
    for (const int threads : {1, 2}) {
      const ThreadLimit limit(threads);
      const std::string who =
          "witherfield, " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
      auto begin = Clock::now();
      ours.refinement->evaluate(ours.control, out);
      table[who].push_back(seconds_since(begin));
      if (threads == 1) state.SetIterationTime(table[who].back());
      begin = Clock::now();
      ours.refinement->evaluate(control, refined);
      table[who + ", doubles"].push_back(seconds_since(begin));
    }
    const auto begin = Clock::now();
    stencils.evaluate(input.position);
    table["OpenSubdiv Osd::CpuEvaluator"].push_back(seconds_since(begin));
    double square = 0;
    for (const auto& p : out) square += double(glm::dot(p, p)) / double(out.size());
    if (std::abs(square / stencils.mean_square() - 1) > (state.range(0) ? 2e-3 : 1e-5))
      state.SkipWithError("OpenSubdiv's stencils give another surface");
  }
}

void print_tables() {
  for (const auto& [title, table] : results()) {
    double best = INFINITY;
    for (const auto& [who, times] : table)
      if (who.rfind("witherfield", 0) != 0 && times.size() > 1) best = std::min(best, median(times));
    std::printf("\n%-46s %10s %10s %22s\n", title.c_str(), "least ms", "median ms", "best peer is slower by");
    for (const auto& [who, times] : table) {
      std::printf("%-46s %10.2f %10.2f", who.c_str(), 1e3 * *std::min_element(times.begin(), times.end()),
                  1e3 * median(times));
      if (who.rfind("witherfield", 0) == 0) std::printf(" %22.1f", best / median(times));
      std::printf("\n");
    }
  }
}

BENCHMARK(refine_in_turn)
    ->ArgNames({"creased", "fresh"})
    ->ArgsProduct({{0, 1}, {0, 1}})
    ->UseManualTime()
    ->Iterations(11)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(evaluate_again)
    ->ArgNames({"creased"})
    ->Arg(0)
    ->Arg(1)
    ->UseManualTime()
    ->Iterations(41)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace witherfield::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  witherfield::bench::print_tables();
  benchmark::Shutdown();
}
