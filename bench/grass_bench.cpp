// The timing case of Jiao et al. 2010: a 256^3 texel with 100 blades, stage by stage, against the paper's
// times and against OpenVDB. Two numbers of points: the paper's about 5,000, and what the default proportion
// gives.
//
//   grass_bench                                 all; ends with a table of targets
//   grass_bench --benchmark_filter=step         some
//
// Argument 1 = default proportion (0 = the paper's 5,000 points), argument 2 = threads.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "bench/openvdb_splat.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/mechanics.hpp"
#include "sim/grass/points.hpp"
#include "sim/grass/voxelize.hpp"
#include "vis/writers.hpp"

namespace witherfield::bench {
namespace {

using namespace grass;
using Clock = std::chrono::steady_clock;

constexpr double kPointMass = 1e-8;
constexpr double kStep = 1.0 / 240;  // of wd: 60 days, 4 steps a day

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double least(const std::vector<double>& v) {
  return *std::min_element(v.begin(), v.end());
}

double median(std::vector<double> v) {
  if (v.empty()) return std::nan("");
  std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
  return v[v.size() / 2];
}

/// Highest resident memory of the process so far, MiB.
double peak_MiB() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0) return std::stod(line.substr(6)) / 1024;
  return std::nan("");
}

/// Times of a stage, gathered for the table at the end.
std::map<std::string, std::vector<double>>& results() {
  static std::map<std::string, std::vector<double>> all;
  return all;
}

GrassOptions paper_case(Motion motion) {
  GrassOptions options;
  options.samples.resize(1);
  options.samples[0].blades.count = 100;
  options.tissue.motion = motion;
  return options;
}

/// The texel at wd = 0, its blades, and its points.
struct Case {
  GrassOptions options;
  GridShape shape;
  BladeMotion motion;
  BladeState initial;
  TexelGrid texel;

  explicit Case(Motion how)
      : options(paper_case(how)),
        shape(texel_shape(options.texel)),
        motion(make_blades(options.samples[0].blades, options.texel.size_m, options.season,
                           options.colour.brightness_sd, 1, 0),
               options.samples[0].blades, options.season, options.tissue, options.colour),
        initial(motion.state()),
        texel(voxelize(initial, shape, options.tissue.vein_fraction)) {}

  double proportion(bool by_default) const {
    return by_default ? options.points.proportion : 5000 / texel.total_density();
  }
  double merge_m() const { return options.points.merge_distance_voxels * shape.spacing_m; }
  PointSet points(bool by_default) const {
    PointSet p = sample_points(texel, proportion(by_default), kPointMass, 1);
    attach_to_blades(p, initial, 0, shape.tile_m());
    return p;
  }
};

const Case& rod_case() {
  static const Case c(Motion::rod);
  return c;
}

/// The points at wd = 0.3, moved and merged.
const PointSet& withered(bool by_default) {
  static std::map<bool, PointSet> cache;
  if (const auto found = cache.find(by_default); found != cache.end()) return found->second;
  const Case& c = rod_case();
  Case moving(Motion::rod);
  moving.motion.advance_to(0.3);
  PointSet p = c.points(by_default);
  ride_on_blades(p, c.initial, moving.motion.state());
  merge_points(p, c.merge_m());
  const double width = c.shape.nx * c.shape.spacing_m, tile = c.shape.tile_m();
  for (glm::dvec3& x : p.position_m)  // the peer does not wrap
    for (int a : {0, 1}) {
      if (x[a] < c.shape.origin_m[a]) x[a] += tile;
      if (x[a] >= c.shape.origin_m[a] + width) x[a] -= tile;
    }
  return cache[by_default] = std::move(p);
}

/// Runs and records a stage. `prepare` is not timed.
template <class Prepare, class Body>
void measure(benchmark::State& state, const std::string& stage, const Prepare& prepare, const Body& body) {
  const std::string key =
      stage + (state.range(0) ? " default" : " 5000") + " x" + std::to_string(state.range(1));
  const ThreadLimit limit(int(state.range(1)));
  for (auto _ : state) {
    prepare();
    const auto start = Clock::now();
    body();
    const double t = seconds_since(start);
    state.SetIterationTime(t);
    results()[key].push_back(t);
  }
}

void texel_to_points(benchmark::State& state) {
  const Case& c = rod_case();
  const double proportion = c.proportion(state.range(0));
  PointSet p;
  measure(
      state, "texel_to_points", [] {}, [&] { p = sample_points(c.texel, proportion, kPointMass, 1); });
  state.counters["points"] = double(p.size());
}

/// One step: the blades move on by a quarter of a day, the points ride, near points combine.
void step(benchmark::State& state, Motion how) {
  Case c(how);
  const PointSet start = c.points(state.range(0));
  PointSet p = start;
  const BladeMotion beginning = [&] {
    Case fresh(how);
    return std::move(fresh.motion);
  }();
  int steps = 0;
  measure(
      state, how == Motion::rod ? "step" : "step_paper_model",
      [&] {
        if (++steps % 200) return;
        c.motion = BladeMotion(beginning.blades(), c.options.samples[0].blades, c.options.season,
                               c.options.tissue, c.options.colour);
        p = start;
      },
      [&] {
        c.motion.advance_to(c.motion.wd() + kStep);
        ride_on_blades(p, c.initial, c.motion.state());
        merge_points(p, c.merge_m());
      });
  state.counters["points"] = double(p.size());
}

void points_to_texel(benchmark::State& state) {
  const Case& c = rod_case();
  TexelGrid out;
  const PointSet& p = withered(state.range(0));
  measure(
      state, "points_to_texel", [] {},
      [&] { splat_points(p, c.shape, c.options.points.kernel_sigma_voxels, out); });
  state.counters["voxels"] = double(out.occupied_voxels());
}

/// Both files of a key frame, as a run writes them.
void points_to_texel_and_store(benchmark::State& state) {
  const Case& c = rod_case();
  TexelGrid out;
  const PointSet& p = withered(state.range(0));
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "witherfield_bench";
  std::filesystem::create_directories(folder);
  measure(
      state, "points_to_texel_and_store", [] {},
      [&] {
        splat_points(p, c.shape, c.options.points.kernel_sigma_voxels, out);
        const TexelGrid::Box box = out.occupied_box();
        const vis::TexelPlan plan(out, {box.lo, box.hi});
        vis::write_texel_vti(folder / "texel.vti", plan, false, {18, 0.3});
        vis::write_texel_vti(folder / "optics.vti", plan, true, {18, 0.3});
      });
  std::filesystem::remove_all(folder);
}

double& own_peak_MiB() {
  static double peak = 0;
  return peak;
}

/// Ours and the peer's in turn, so that whatever else the machine does falls on both alike. One thread.
void against_openvdb(benchmark::State& state) {
  if (own_peak_MiB() == 0) own_peak_MiB() = peak_MiB();  // before the peer adds to it
  const ThreadLimit limit(1);
  const Case& c = rod_case();
  const PointSet& p = withered(state.range(0));
  const ScatterGrid grid{c.shape.nx, c.shape.ny, c.shape.nz, c.shape.origin_m, c.shape.spacing_m};
  // The paper's few points lie some voxels apart along a blade: their kernel must be wide to make blades of them again.
  const double sigma = state.range(0) == 0 ? 1.0 : c.options.points.kernel_sigma_voxels;
  std::vector<double> ours, peers;
  TexelGrid out;
  std::unique_ptr<OpenvdbSplat> peer;
  for (auto _ : state) {
    peer.reset();
    auto start = Clock::now();
    splat_points(p, c.shape, sigma, out);
    ours.push_back(seconds_since(start));
    start = Clock::now();
    peer = std::make_unique<OpenvdbSplat>(p, grid, sigma);
    peers.push_back(seconds_since(start));
    state.SetIterationTime(ours.back());
  }
  double worst = 0;
  for (int b = 0; b < out.brick_count(); ++b)
    for (int v = 0; v < TexelGrid::kVoxels; ++v) {
      const glm::ivec3 at = out.brick_base(b) + glm::ivec3(v % 4, v / 4 % 4, v / 16);
      const double w = out.channel(b, TexelChannel::density)[v] * p.proportion;
      worst = std::max(worst, std::abs(w - peer->weight(at.x, at.y, at.z)) / (w + 1e-3));
    }
  if (worst > 1e-4 || std::int64_t(peer->voxels()) != out.occupied_voxels())
    state.SkipWithError("the two splats differ");
  const std::string key = state.range(0) ? " default" : " 5000";
  results()["openvdb" + key] = peers;
  results()["duel" + key] = ours;
  state.counters["openvdb_ms"] = 1e3 * median(peers);
  state.counters["ratio"] = median(peers) / median(ours);
}

void print_targets() {
  struct Target {
    const char* stage;
    double paper_s, factor;
  };
  const auto row = [](const std::string& name, const std::vector<double>& times, double other_s,
                      double factor, const char* of_what) {
    const double m = median(times);
    std::printf("%-36s %11.3f %11.3f %11.3f %9.1f %8.0f  %s\n", name.c_str(), 1e3 * least(times), 1e3 * m,
                1e3 * other_s, other_s / m, factor, of_what);
  };
  std::printf("\n%-36s %11s %11s %11s %9s %8s\n", "stage, points, threads", "least ms", "median ms",
              "other ms", "faster", "target");
  for (const Target& t :
       {Target{"texel_to_points", 0.22, 100}, Target{"step", 6.3, 1000},
        Target{"step_paper_model", 6.3, 1000}, Target{"points_to_texel_and_store", 2.61, 30}})
    for (const auto& [key, times] : results())
      if (key.rfind(std::string(t.stage) + " ", 0) == 0) row(key, times, t.paper_s, t.factor, "the paper");
  for (const char* points : {" 5000", " default"})
    if (results().contains(std::string("duel") + points))
      row("points_to_texel" + std::string(points) + " x1", results()[std::string("duel") + points],
          median(results()[std::string("openvdb") + points]), 5, "OpenVDB accessor scatter in the same run");
  std::printf("peak memory before the peer %.0f MiB (target 300)\n",
              own_peak_MiB() > 0 ? own_peak_MiB() : peak_MiB());
}

void points_and_threads(benchmark::internal::Benchmark* b) {
  b->ArgNames({"default", "threads"})
      ->ArgsProduct({{0, 1}, {1, 2}})
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

BENCHMARK(texel_to_points)->Apply(points_and_threads);
BENCHMARK_CAPTURE(step, rod, Motion::rod)->Apply(points_and_threads);
BENCHMARK_CAPTURE(step, paper_model, Motion::paper)->Apply(points_and_threads);
BENCHMARK(points_to_texel)->Apply(points_and_threads);
BENCHMARK(points_to_texel_and_store)->Apply(points_and_threads);
BENCHMARK(against_openvdb)
    ->ArgNames({"default"})
    ->Arg(0)
    ->Arg(1)
    ->UseManualTime()
    ->Iterations(15)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace witherfield::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  witherfield::bench::print_targets();
  benchmark::Shutdown();
}
