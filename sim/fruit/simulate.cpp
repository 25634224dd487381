#include "sim/fruit/simulate.hpp"

#include <algorithm>
#include <chrono>
#include <glm/common.hpp>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/fruit/model.hpp"

namespace witherfield::fruit {
namespace {

class StopWatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Means over the kernels of one frame.
void measure(const Fruit& fruit, const Surface& s, FruitReport::Frame& frame) {
  const OrganRanges ranges = organ_ranges(fruit, 0, fruit.organs.size());
  std::vector<glm::dvec2> size(fruit.organs.size());
  parallel_for(fruit.organs.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (fruit.organs[i].kernel >= 0)
        size[i] = {enclosed_volume_m3(s, ranges.face[i], ranges.face[i + 1]),
                   area_m2(s, ranges.face[i], ranges.face[i + 1])};
  });
  int kernels = 0;
  for (std::size_t i = 0; i < fruit.organs.size(); ++i) {
    if (fruit.organs[i].kernel < 0) continue;
    ++kernels;
    frame.moisture_wb += double(fruit.organs[i].coat.moisture_wb);
    frame.kernel_volume_mm3 += size[i].x * 1e9;
    frame.kernel_area_mm2 += size[i].y * 1e6;
  }
  if (kernels > 0) {
    frame.moisture_wb /= kernels;
    frame.kernel_volume_mm3 /= kernels;
    frame.kernel_area_mm2 /= kernels;
  }
  glm::dvec3 lo(1e300), hi(-1e300);
  for (const glm::dvec3& p : s.position_m) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  frame.size_m = hi - lo;
}

/// Voxels of a thirtieth of a kernel's girth, coarser for many or scattered kernels.
double overlap_voxel_m(const FruitReport& report) {
  const glm::dvec3& s = report.frames.back().size_m;
  const double fine = std::cbrt(report.frames.back().kernel_volume_mm3 * 1e-9) / 16;
  return std::max(fine, std::cbrt(s.x * s.y * s.z / 6e7));
}

}  // namespace

FruitReport simulate(const FruitOptions& options, const FrameSink& sink, const Progress& progress) {
  FruitReport report;
  const StopWatch setup;
  const std::unique_ptr<FruitModel> model = make_model(options);
  report.setup_seconds = setup.seconds();
  report.spikelets = model->spikelets();
  report.rows = model->rows();
  for (std::size_t i = 0; i < options.frames.size(); ++i) {
    if (progress) progress("fruit", double(i) / double(options.frames.size()));
    const StopWatch watch;
    FruitFrame frame;
    frame.index = int(i);
    frame.wd = options.frames[i];
    frame.time_days = frame.wd * options.ripening.length_days;
    const Fruit fruit = model->at(frame.wd);
    frame.surface = mesh_organs(fruit, 0, fruit.organs.size());
    FruitReport::Frame measured{.wd = frame.wd, .time_days = frame.time_days, .seconds = watch.seconds()};
    measure(fruit, frame.surface, measured);
    report.frames.push_back(measured);
    report.organs = int(fruit.organs.size());
    report.kernels = int(std::count_if(fruit.organs.begin(), fruit.organs.end(),
                                       [](const Organ& o) { return o.kernel >= 0; }));
    report.vertices = frame.surface.position_m.size();
    report.triangles = frame.surface.triangles.size();
    if (i + 1 == options.frames.size() && report.kernels > 1)
      report.overlap = overlap_share(frame.surface, overlap_voxel_m(report));
    if (sink) sink(frame);
  }
  if (progress) progress("fruit", 1);
  return report;
}

std::vector<Shell> shells(const FruitOptions& options, double wd) {
  if (!(wd >= 0 && wd <= 1)) throw InvalidInput("shells: wd = " + std::to_string(wd) + " is outside 0..1");
  const std::unique_ptr<FruitModel> model = make_model(options);
  const Fruit fruit = model->at(wd);
  std::vector<Shell> all(fruit.organs.size());
  parallel_for(all.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Organ& o = fruit.organs[i];
      all[i] = {o.name, o.kind, o.kernel, mesh_organs(fruit, i, i + 1)};
    }
  });
  return all;
}

Surface kernel_step(const FruitOptions& options, int step) {
  if (step < 0 || step > 4)
    throw InvalidInput("kernel_step: step = " + std::to_string(step) + " is outside 0..4");
  FruitOptions o = options;
  o.steps = step;
  const std::unique_ptr<FruitModel> model = make_model(o);
  Fruit one{&model->shapes(), &model->refinements(), {model->kernel_at_rest()}};
  return mesh_organs(one, 0, 1);
}

ControlMesh kernel_control(const FruitOptions& options) {
  const std::unique_ptr<FruitModel> model = make_model(options);
  const Organ kernel = model->kernel_at_rest();
  ControlMesh mesh = model->shapes()[std::size_t(kernel.shape)].mesh;
  mesh.position_m = kernel.control_m;
  return mesh;
}

}  // namespace witherfield::fruit
