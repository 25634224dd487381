// Footprints into a floor: a 99 x 99 sole, turned and shifted, into a 4096^2 plane of floats, against OpenCV in the same
// run; then walkers and whole floors.
//
//   floor_bench                                  all; ends with a table of targets
//   floor_bench --benchmark_filter=stamps        some
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <map>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "sim/core/parallel.hpp"
#include "sim/core/random.hpp"
#include "sim/floor/masks.hpp"
#include "sim/floor/simulate.hpp"
#include "sim/floor/stamp.hpp"
#include "tests/floor/floor_rooms.hpp"

namespace witherfield::bench {
namespace {

using namespace floor;
using Clock = std::chrono::steady_clock;

constexpr int kSide = 4096;
constexpr int kSole = 99;
constexpr int kAngles = 360;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Processor time of the process: what one thread needs, whatever else the machine does.
double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

double median(std::vector<double> v) {
  if (v.empty()) return std::nan("");
  std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
  return v[v.size() / 2];
}

double status_MiB(const char* what) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind(what, 0) == 0) return std::stod(line.substr(std::strlen(what))) / 1024;
  return std::nan("");
}

/// Prints a second of every contender, gathered for the table.
std::map<std::string, std::vector<double>>& rates() {
  static std::map<std::string, std::vector<double>> all;
  return all;
}

/// An ellipse that covers 44 % of 99 x 99 cells: as many as a large sole with its slide.
const std::vector<float>& ellipse() {
  static const std::vector<float> values = [] {
    std::vector<float> v(kSole * kSole);
    for (int j = 0; j < kSole; ++j)
      for (int i = 0; i < kSole; ++i) {
        const double r = std::hypot((i - 49) / 48.0, (j - 49) / 29.0);
        if (r < 1) v[std::size_t(j * kSole + i)] = float(1 - 0.6 * r * r);
      }
    return v;
  }();
  return values;
}

/// A man's sole of ours as large as fits.
const std::vector<float>& sole() {
  static const std::vector<float> values = make_mask(Sole::man, 0.271, 330, kSole).pressure;
  return values;
}

const std::vector<float>& mask(bool of_ellipse) { return of_ellipse ? ellipse() : sole(); }

std::vector<Placement> random_placements(std::size_t n) {
  std::vector<Placement> all(n);
  Random r(7, Stream::test, n);
  for (Placement& p : all) {
    p.x = float(r.uniform(60, kSide - 60));
    p.y = float(r.uniform(60, kSide - 60));
    p.angle = std::uint16_t(r.uniform() * kAngles);
    p.scale[0] = 1;
  }
  return all;
}

std::vector<float>& plane() {
  static std::vector<float> values(std::size_t(kSide) * kSide);
  return values;
}

void ours(std::span<const Placement> all, const std::vector<StampSet>& sets) {
  const StampPass pass[] = {{&sets, {{plane().data(), 0}}}};
  add_stamps(all, pass, kSide, kSide);
}

cv::Mat region(cv::Mat& floor, const Placement& p) {
  return floor(cv::Rect(int(p.x) - kSole / 2, int(p.y) - kSole / 2, kSole, kSole));
}

/// Turn and sub-pixel shift of a stamp, for warpAffine.
cv::Mat turn(const Placement& p) {
  cv::Mat m = cv::getRotationMatrix2D({kSole / 2, kSole / 2}, -360.0 * p.angle / kAngles, 1);
  m.at<double>(0, 2) += double(p.x) - std::floor(p.x) - 0.5;
  m.at<double>(1, 2) += double(p.y) - std::floor(p.y) - 0.5;
  return m;
}

void warp_and_add(std::span<const Placement> all, const cv::Mat& stamp) {
  cv::Mat floor(kSide, kSide, CV_32F, plane().data()), turned;
  for (const Placement& p : all) {
    cv::Mat to = region(floor, p);
    cv::warpAffine(stamp, turned, turn(p), stamp.size(), cv::INTER_LINEAR, cv::BORDER_CONSTANT);
    cv::add(to, turned, to);
  }
}

void pre_turned_and_add(std::span<const Placement> all, const std::vector<cv::Mat>& stamps) {
  cv::Mat floor(kSide, kSide, CV_32F, plane().data());
  for (const Placement& p : all) {
    cv::Mat to = region(floor, p);
    cv::add(to, stamps[p.angle], to);
  }
}

/// The contenders in turn, so that whatever else the machine does falls on all alike.
void stamps_against_opencv(benchmark::State& state) {
  const bool of_ellipse = state.range(0);
  const int threads = int(state.range(1));
  const ThreadLimit limit(threads);
  cv::setNumThreads(threads);
  const std::vector<float>& values = mask(of_ellipse);
  const std::vector<StampSet> sets(1, StampSet(values, kSole, kAngles));
  const cv::Mat stamp(kSole, kSole, CV_32F, const_cast<float*>(values.data()));
  const std::vector<Placement> all = random_placements(200000);
  std::vector<cv::Mat> turned(kAngles);
  for (int a = 0; a < kAngles; ++a) {
    Placement p;
    p.x = p.y = 0.5f;
    p.angle = std::uint16_t(a);
    cv::warpAffine(stamp, turned[std::size_t(a)], turn(p), stamp.size(), cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  }
  const std::string key = std::string(of_ellipse ? "ellipse" : "sole") + " x" + std::to_string(threads);
  const auto timed = [&](const char* who, std::size_t n, const auto& body) {
    const auto start = Clock::now();
    const double cpu = cpu_seconds();
    body(std::span(all).first(n));
    // One thread: processor time. Two: wall clock.
    const double rate = double(n) / (threads == 1 ? cpu_seconds() - cpu : seconds_since(start));
    rates()[who + (" " + key)].push_back(rate);
    return rate;
  };
  std::fill(plane().begin(), plane().end(), 0.0f);
  ours(std::span(all).first(100), sets);  // pages, buffers
  for (auto _ : state) {
    const double own = timed("ours", all.size(), [&](auto some) { ours(some, sets); });
    timed("warp", 8000, [&](auto some) { warp_and_add(some, stamp); });
    timed("pre-turned", 60000, [&](auto some) { pre_turned_and_add(some, turned); });
    state.SetIterationTime(double(all.size()) / own);
  }
  const auto rate = [&](const char* who) { return median(rates()[who + (" " + key)]); };
  state.counters["stamps_per_s"] = rate("ours");
  state.counters["over_warp"] = rate("ours") / rate("warp");
  state.counters["over_pre_turned"] = rate("ours") / rate("pre-turned");
}

/// Time must grow in step with the number of prints, memory not at all.
void stamps_linear(benchmark::State& state) {
  const ThreadLimit limit(1);
  const std::vector<StampSet> sets(1, StampSet(ellipse(), kSole, kAngles));
  const std::size_t n = std::size_t(state.range(0));
  for (auto _ : state) {
    double seconds = 0;
    for (std::size_t done = 0; done < n; done += 250000) {  // as the simulator does: in portions
      const std::vector<Placement> some = random_placements(std::min<std::size_t>(250000, n - done));
      const auto start = Clock::now();
      ours(some, sets);
      seconds += seconds_since(start);
    }
    state.SetIterationTime(seconds);
  }
  state.counters["ns_per_stamp"] =
      benchmark::Counter(1e-9 * double(n), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["peak_MiB"] = status_MiB("VmHWM:");
}

/// What memory allows: reading and writing as many floats as the stamps touch, in a row, from DRAM.
void memory_bandwidth(benchmark::State& state) {
  std::vector<float>& v = plane();
  for (auto _ : state) {
    const auto start = Clock::now();
    for (float& x : v) x += 1.0f;
    benchmark::ClobberMemory();
    const double s = seconds_since(start);
    rates()["plane += 1, GB/s"].push_back(8e-9 * double(v.size()) / s);
    state.SetIterationTime(s);
  }
}

void walkers(benchmark::State& state) {
  FloorOptions o = state.range(0) == 0 ? patrol_gallery() : state.range(0) == 1 ? office_round_trips() : stone_stairs();
  o.crowd.visits = 20000;
  const ThreadLimit limit(int(state.range(1)));
  std::int64_t steps = 0;
  for (auto _ : state) {
    const auto start = Clock::now();
    steps = walk(o, [](std::span<const Footprint> p) { benchmark::DoNotOptimize(p.data()); }).footprints;
    state.SetIterationTime(seconds_since(start));
  }
  state.counters["steps"] = double(steps);
  state.counters["steps_per_s"] = benchmark::Counter(double(steps), benchmark::Counter::kIsIterationInvariantRate);
}

/// All channels of the office floor.
void whole_floor(benchmark::State& state) {
  FloorOptions o = office_round_trips();
  o.crowd.visits = state.range(0);
  o.frames = {1};
  const ThreadLimit limit(2);
  FloorReport report;
  for (auto _ : state) {
    const auto start = Clock::now();
    report = simulate(o, [](const FloorFrame& f) { benchmark::DoNotOptimize(f.floors.data()); });
    state.SetIterationTime(seconds_since(start));
  }
  for (const auto& s : report.stages) state.counters[s.name + "_s"] = s.seconds;
  state.counters["prints"] = double(report.walk.footprints);
  state.counters["peak_MiB"] = status_MiB("VmHWM:");
}

void print_targets() {
  std::printf("\n%-16s %14s %14s %14s %10s %10s\n", "99 x 99, float", "ours 1/s", "warp+add 1/s", "pre-turned 1/s", "x warp",
              "x pre-t.");
  for (const char* key : {"ellipse x1", "ellipse x2", "sole x1", "sole x2"}) {
    const auto rate = [&](const char* who) { return median(rates()[who + (std::string(" ") + key)]); };
    if (std::isnan(rate("ours"))) continue;
    std::printf("%-16s %14.0f %14.0f %14.0f %10.1f %10.1f\n", key, rate("ours"), rate("warp"), rate("pre-turned"),
                rate("ours") / rate("warp"), rate("ours") / rate("pre-turned"));
  }
  std::printf("targets: 40 x warpAffine + add, 4 x pre-turned stamps + cv::add (which places on whole cells)\n");
  if (const double gb = median(rates()["plane += 1, GB/s"]); !std::isnan(gb) && rates().contains("ours ellipse x1")) {
    double cells = 0;
    for (const float v : ellipse()) cells += v > 0;
    std::printf("a sweep over the plane moves %.1f GB/s; the stamps change %.1f GB/s of floats (read and write)\n", gb,
                8e-9 * cells * median(rates()["ours ellipse x1"]));
  }
}

BENCHMARK(stamps_against_opencv)
    ->ArgNames({"ellipse", "threads"})->ArgsProduct({{1, 0}, {1, 2}})->UseManualTime()->Iterations(7)->Unit(benchmark::kMillisecond);
BENCHMARK(stamps_linear)
    ->ArgName("prints")->Arg(62500)->Arg(250000)->Arg(1000000)->UseManualTime()->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK(memory_bandwidth)->UseManualTime()->Iterations(9)->Unit(benchmark::kMillisecond);
BENCHMARK(walkers)->ArgNames({"room", "threads"})->ArgsProduct({{0, 1, 2}, {1, 2}})->UseManualTime()->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK(whole_floor)->ArgName("visits")->Arg(10000)->Arg(100000)->Arg(1000000)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace witherfield::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  witherfield::bench::print_targets();
  benchmark::Shutdown();
}
