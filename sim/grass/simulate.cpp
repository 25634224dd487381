#include "sim/grass/simulate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "sim/core/curve.hpp"
#include "sim/core/errors.hpp"
#include "sim/grass/mechanics.hpp"
#include "sim/grass/mingle.hpp"
#include "sim/grass/points.hpp"
#include "sim/grass/voxelize.hpp"

namespace witherfield::grass {
namespace {

/// Adds the wall clock of its life to a stage of the report.
class StageTimer {
 public:
  StageTimer(GrassReport& report, const char* name) : report_(report), name_(name), start_(std::chrono::steady_clock::now()) {}
  ~StageTimer() {
    const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    for (auto& stage : report_.stages)
      if (stage.name == name_) {
        stage.seconds += s;
        return;
      }
    report_.stages.push_back({name_, s});
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  GrassReport& report_;
  const char* name_;
  std::chrono::steady_clock::time_point start_;
};

/// One sample of one variant through the season: blades -> texel -> points, then points ride on the drying blades.
struct SampleRun {
  const SampleOptions* options;
  Curve ageing;  // Mg_i; empty = identity
  int first_blade_id;
  std::unique_ptr<BladeMotion> motion;
  BladeState initial, now;
  PointSet points;
  TexelGrid initial_texel, splatted;
  const TexelGrid* texel = nullptr;  // the frame's

  double own_wd(double wd) const { return ageing.empty() ? wd : std::clamp(ageing(wd), 0.0, 1.0); }
};

double fresh_mass_kg(const std::vector<Blade>& blades, const BladeOptions& options, double density_kg_m3) {
  double mass = 0;
  constexpr int n = 32;
  for (const Blade& b : blades)
    for (int k = 0; k < n; ++k) {
      const double w = b.width_m * width_profile(options.form, (k + 0.5) / n);
      const double section = options.form == BladeForm::cone ? 0.7853981633974483 * w * w : w * b.thickness_m;
      mass += density_kg_m3 * section * b.length_m / n;
    }
  return mass;
}

class GrassRun {
 public:
  GrassRun(const GrassOptions& options, const FrameSink& sink, const Progress& progress)
      : o_(options), sink_(sink), progress_(progress), shape_(texel_shape(options.texel)) {}

  GrassReport run() {
    total_ = double(o_.wd_frames.size()) + double(o_.variants - 1) * double(frames_of(1).size());
    for (int v = 0; v < o_.variants; ++v) run_variant(v);
    return report_;
  }

 private:
  const std::vector<double>& frames_of(int variant) const {
    return variant > 0 && !o_.wd_frames_other_variants.empty() ? o_.wd_frames_other_variants : o_.wd_frames;
  }

  /// Variants age at different rates: wd^(2^(spread x)), x evenly from -1 (early) to 1 (late).
  double variant_wd(int variant, double wd) const {
    if (o_.variants == 1 || o_.variant_spread == 0) return wd;
    return std::pow(wd, std::exp2(o_.variant_spread * (2.0 * variant / (o_.variants - 1) - 1)));
  }

  SampleRun start(int variant, std::size_t i, int first_blade_id) {
    SampleRun s;
    s.options = &o_.samples[i];
    s.first_blade_id = first_blade_id;
    if (!s.options->ageing.empty()) s.ageing = Curve(s.options->ageing, "ageing");
    const std::uint64_t stream = std::uint64_t(variant) * 4096 + i;
    const int twin = s.options->blades.twin;
    const std::uint64_t blade_stream = twin < 0 ? stream : (std::uint64_t(twin) + 1) << 20 | std::uint64_t(variant);
    {
      StageTimer timer(report_, "blades");
      std::vector<Blade> blades = make_blades(s.options->blades, o_.texel.size_m, s.options->season,
                                              o_.colour.brightness_sd, o_.seed, blade_stream);
      report_.blades += int(blades.size());
      s.motion = std::make_unique<BladeMotion>(std::move(blades), s.options->blades, s.options->season, o_.tissue, o_.colour);
      s.initial = s.motion->state();
      s.now = s.initial;
    }
    {
      StageTimer timer(report_, "voxelize");
      s.initial_texel = voxelize(s.initial, shape_, o_.tissue.vein_fraction, first_blade_id);
    }
    StageTimer timer(report_, "texel_to_points");
    const double expected_points = std::max(1.0, o_.points.proportion * s.initial_texel.total_density());
    const double mass = fresh_mass_kg(s.motion->blades(), s.options->blades, o_.tissue.density_kg_m3);
    s.points = sample_points(s.initial_texel, o_.points.proportion, mass / expected_points,
                             o_.seed ^ (stream * 0x9E3779B97F4A7C15ull));
    attach_to_blades(s.points, s.initial, first_blade_id, shape_.tile_m());
    report_.points_first += s.points.size();
    s.splatted = TexelGrid(shape_);
    return s;
  }

  void advance(SampleRun& s, double wd) {
    const double own = s.own_wd(wd);
    if (own == 0) {  // not aged yet: the voxelised texel itself
      s.texel = &s.initial_texel;
      return;
    }
    {
      StageTimer timer(report_, "dynamics");
      s.motion->advance_to(own);
      s.now = s.motion->state();
      ride_on_blades(s.points, s.initial, s.now, s.first_blade_id);
      if (o_.points.merge_distance_voxels > 0)
        report_.merges += merge_points(s.points, o_.points.merge_distance_voxels * shape_.spacing_m);
    }
    StageTimer timer(report_, "points_to_texel");
    splat_points(s.points, shape_, o_.points.kernel_sigma_voxels, s.splatted);
    s.texel = &s.splatted;
    check(s);
  }

  void check(const SampleRun& s) {
    double weight = 0;
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      weight += s.points.mass_kg[i] / s.points.point_mass_kg;
      const glm::dvec3& p = s.points.position_m[i];
      report_.all_finite = report_.all_finite && std::isfinite(p.x + p.y + p.z + double(s.points.water[i]) +
                                                               double(s.points.stress_vein_MPa[i]) + double(s.points.diffuse[i].x));
    }
    const double expected = weight / s.points.proportion;
    if (expected > 0)
      report_.density_error_max = std::max(report_.density_error_max, std::abs(s.splatted.total_density() - expected) / expected);
    const std::size_t n = std::size_t(s.now.nodes_per_blade());
    for (std::size_t b = 0; b < s.now.node_m.size(); b += n)
      report_.root_shift_max_m = std::max(report_.root_shift_max_m, glm::distance(s.now.node_m[b], s.initial.node_m[b]));
  }

  void run_variant(int variant) {
    std::vector<SampleRun> samples;
    int blade_id = 0;
    for (std::size_t i = 0; i < o_.samples.size(); ++i) {
      samples.push_back(start(variant, i, blade_id));
      blade_id += o_.samples[i].blades.count;
    }
    const std::vector<double>& frames = frames_of(variant);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      for (SampleRun& s : samples) advance(s, variant_wd(variant, frames[f]));
      emit(variant, int(f), frames[f], samples);
      if (progress_) progress_("simulating grass", (done_ += 1) / total_);
    }
    for (const SampleRun& s : samples) report_.points_last += s.points.size();
  }

  void emit(int variant, int index, double wd, const std::vector<SampleRun>& samples) {
    std::vector<const TexelGrid*> grids;
    std::vector<const BladeState*> states;
    for (const SampleRun& s : samples) {
      grids.push_back(s.texel);
      states.push_back(&s.now);
    }
    TexelGrid mingled;
    if (grids.size() > 1) {
      StageTimer timer(report_, "mingle");
      mingled = mingle(grids);
    }
    PointSet all;
    if (samples.size() > 1) all = concatenate(samples);
    const BladeRibbons ribbons = to_ribbons(states);
    GrassFrame frame;
    frame.variant = variant;
    frame.index = index;
    frame.wd = wd;
    frame.time_days = wd * o_.season.length_days;
    frame.texel = grids.size() > 1 ? &mingled : grids[0];
    frame.points = samples.size() > 1 ? &all : &samples[0].points;
    frame.blades = &ribbons;
    StageTimer timer(report_, "writing");
    sink_(frame);
  }

  static PointSet concatenate(const std::vector<SampleRun>& samples) {
    PointSet all;
    all.proportion = samples[0].points.proportion;
    all.radius_m = samples[0].points.radius_m;
    all.point_mass_kg = samples[0].points.point_mass_kg;
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    for (const SampleRun& s : samples) {
      const PointSet& p = s.points;
      append(all.position_m, p.position_m);
      append(all.velocity_m_s, p.velocity_m_s);
      append(all.mass_kg, p.mass_kg);
      append(all.normal, p.normal);
      append(all.normal_local, p.normal_local);
      append(all.tangent, p.tangent);
      append(all.blade_id, p.blade_id);
      append(all.arc, p.arc);
      append(all.offset, p.offset);
      append(all.tissue, p.tissue);
      append(all.water, p.water);
      append(all.chlorophyll_ug_cm2, p.chlorophyll_ug_cm2);
      append(all.stress_vein_MPa, p.stress_vein_MPa);
      append(all.stress_mesophyll_MPa, p.stress_mesophyll_MPa);
      append(all.strain_shrink, p.strain_shrink);
      append(all.specular, p.specular);
      append(all.diffuse, p.diffuse);
    }
    return all;
  }

  const GrassOptions& o_;
  const FrameSink& sink_;
  const Progress& progress_;
  GridShape shape_;
  GrassReport report_;
  double done_ = 0, total_ = 1;
};

}  // namespace

GrassReport simulate_grass(const GrassOptions& options, const FrameSink& sink, const Progress& progress) {
  validate(options);
  return GrassRun(options, sink, progress).run();
}

}  // namespace witherfield::grass
