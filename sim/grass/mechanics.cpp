#include "sim/grass/mechanics.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/pigments.hpp"

namespace witherfield::grass {
namespace {

constexpr double kGravity = 9.81;           // m/s2
constexpr double kGround_m = 0.0003;        // a lying blade rests this high, so that it is not coplanar with the ground
constexpr double kSupport_m = 0.004;        // within this height litter carries a blade's weight, more the deeper it sinks in

/// One blade's unknowns: rod = curvature and rest curvature per joint; paper = polar angle from the vertical per node.
struct Shape {
  std::vector<double> a, b;
};


/// Everything about one blade that the integrators need and that does not change.
class BladeModel {
 public:
  BladeModel(const Blade& blade, const BladeOptions& options, const TissueOptions& tissue, const SeasonCurves& curves)
      : blade_(&blade), tissue_(&tissue), curves_(&curves), n_(options.segments), form_(options.form) {
    step_m_ = blade.length_m / n_;
    const double fold = form_ == BladeForm::cone ? 0.0 : blade.fold_rad;
    for (int k = 0; k < n_; ++k) {
      const double s = (k + 0.5) / n_, w = std::max(0.02, width_profile(form_, s)) * blade.width_m, t = blade.thickness_m;
      area_.push_back(form_ == BladeForm::cone ? 0.25 * 3.141592653589793 * w * w : w * t);
      // Flat strip plus what the V fold adds: two inclined halves about their common centroid.
      inertia_.push_back(form_ == BladeForm::cone ? 3.141592653589793 * w * w * w * w / 64
                                                  : w * t * t * t / 12 + t * w * w * w * std::sin(fold) * std::sin(fold) / 48);
      // The modulus falls from foot to tip (Balsamo et al. 2006); the blade's mean, in the logarithm, stays what the options say.
      inertia_.back() *= std::pow(tissue.base_to_tip_stiffness, 0.5 - s);
    }
  }

  int segments() const { return n_; }
  double water(double wd, double arc) const { return curves_->spot_water(wd, blade_->onset, arc); }

  /// Centre line of given segment inclinations (from the vertical), with shrunken lengths; never below the ground.
  template <class Inclination>
  void lay_out(double wd, const Inclination& theta, std::vector<glm::dvec3>& nodes) const {
    nodes.resize(std::size_t(n_) + 1);
    glm::dvec3 p = blade_->root_m;
    nodes[0] = p;
    for (int k = 0; k < n_; ++k) {
      const double s = (k + 0.5) / n_;
      const double ds = step_m_ * (1 + tissue_->shrink_length * shrink_progress(*tissue_, water(wd, s)));
      double up = std::cos(theta(k)), out = std::sin(theta(k));
      const double floor_z = k == 0 ? 0.0 : kGround_m;
      if (p.z + up * ds < floor_z) {  // lies on the ground: keep its length
        up = std::clamp((floor_z - p.z) / ds, -1.0, 1.0);
        out = std::copysign(std::sqrt(std::max(0.0, 1 - up * up)), out == 0 ? 1.0 : out);
      }
      const double az = blade_->azimuth_rad + blade_->sway_rad * s;
      p += ds * glm::dvec3(out * std::cos(az), out * std::sin(az), up);
      nodes[std::size_t(k) + 1] = p;
    }
  }

  /// Shape as drawn, which is an equilibrium of the fresh blade.
  Shape initial_rod() const {
    Shape s;
    s.a.resize(std::size_t(n_));
    for (int k = 0; k < n_; ++k) {
      const auto incline = [&](double arc) { return blade_->curl_rad * std::pow(arc, 1.6); };
      s.a[std::size_t(k)] = (incline((k + 0.5) / n_) - (k == 0 ? 0.0 : incline((k - 0.5) / n_))) / step_m_;
    }
    const std::vector<double> sag = moment_curvature(0.0, s.a);
    s.b.resize(s.a.size());
    for (std::size_t k = 0; k < s.a.size(); ++k) s.b[k] = s.a[k] - sag[k];
    return s;
  }

  std::vector<double> inclinations(const std::vector<double>& curvature) const {
    std::vector<double> theta(std::size_t(n_), 0.0);
    double t = blade_->lean_rad;
    for (int k = 0; k < n_; ++k) theta[std::size_t(k)] = (t += curvature[std::size_t(k)] * step_m_);
    return theta;
  }

  /// M / (E I) at each joint: the moment of the weight beyond it over the blade's present stiffness.
  std::vector<double> moment_curvature(double wd, const std::vector<double>& curvature) const {
    const std::vector<double> theta = inclinations(curvature);
    std::vector<double> out(std::size_t(n_), 0.0);
    std::vector<double>& r = scratch_r_;
    std::vector<double>& z = scratch_z_;
    r.assign(std::size_t(n_) + 1, 0.0);
    z.assign(std::size_t(n_) + 1, 0.0);
    for (int k = 0; k < n_; ++k) {
      r[std::size_t(k) + 1] = r[std::size_t(k)] + step_m_ * std::sin(theta[std::size_t(k)]);
      z[std::size_t(k) + 1] = z[std::size_t(k)] + step_m_ * std::cos(theta[std::size_t(k)]);
    }
    double weight = 0, moment_about_origin = 0;
    for (int k = n_ - 1; k >= 0; --k) {
      const std::size_t i = std::size_t(k);
      const double s = (k + 0.5) / n_, w = water(wd, s);
      const double mass = tissue_->density_kg_m3 * area_[i] * step_m_ *
                          (tissue_->dry_mass_fraction + (1 - tissue_->dry_mass_fraction) * w);
      const double z_mid = 0.5 * (z[i] + z[i + 1]);
      const double carried = k < 2 ? 1.0 : std::clamp(z_mid / kSupport_m, -3.0, 1.0);
      const double force = mass * kGravity * carried;
      weight += force;
      moment_about_origin += force * 0.5 * (r[i] + r[i + 1]);
      const double stiffness = bending_modulus_MPa(*tissue_, w) * 1e6 * inertia_[i];
      if (k > 0) out[i] = (moment_about_origin - weight * r[i]) / stiffness;  // the sheath holds the foot
    }
    return out;
  }

  /// d/dt (per day) of the rod: Kelvin-Voigt bending toward the curvature the weight asks for; a limp blade's rest shape creeps.
  Shape rod_rate(double wd, const Shape& x) const {
    const std::vector<double> sag = moment_curvature(wd, x.a);
    Shape d{std::vector<double>(x.a.size()), std::vector<double>(x.a.size())};
    for (std::size_t k = 0; k < x.a.size(); ++k) {
      d.a[k] = (x.b[k] + sag[k] - x.a[k]) / tissue_->response_days;
      d.b[k] = limpness(*tissue_, water(wd, (double(k) + 0.5) / n_)) * (x.a[k] - x.b[k]) / tissue_->creep_days;
    }
    return d;
  }

  /// The paper's turning: every node circles the root, omega_i = omega (h_i / H)^2 (Jiao et al. 2010, sec. 3.1; printed with
  /// 1 / h_i^2, which is slowest at the tip against the paper's own text), driven by the lever arm of its weight.
  Shape paper_rate(double wd, const Shape& x, const std::vector<double>& h_over_H) const {
    Shape d{std::vector<double>(x.a.size()), {}};
    for (std::size_t k = 1; k < x.a.size(); ++k)
      d.a[k] = tissue_->droop_rate_per_day * limpness(*tissue_, water(wd, double(k) / n_)) * h_over_H[k] * h_over_H[k] *
               std::sin(std::min(x.a[k], 1.5707963267948966));
    return d;
  }

 private:
  const Blade* blade_;
  const TissueOptions* tissue_;
  const SeasonCurves* curves_;
  int n_;
  BladeForm form_;
  double step_m_ = 0;
  std::vector<double> area_, inertia_;
  mutable std::vector<double> scratch_r_, scratch_z_;  // one model belongs to one thread at a time
};

Shape axpy(const Shape& x, double h, const Shape& d) {
  Shape y = x;
  for (std::size_t k = 0; k < y.a.size(); ++k) y.a[k] += h * d.a[k];
  for (std::size_t k = 0; k < y.b.size(); ++k) y.b[k] += h * d.b[k];
  return y;
}

}  // namespace

struct BladeMotion::Impl {
  std::vector<Blade> blades;
  BladeOptions blade_options;
  SeasonOptions season;
  TissueOptions tissue;
  ColourOptions colour;
  SeasonCurves curves;
  PigmentTable pigments;
  std::vector<BladeModel> models;
  std::vector<Shape> shapes;
  // Paper's motion: initial centre line in polar form about the root.
  std::vector<std::vector<double>> radius_m, azimuth_rad, h_over_H;
  std::vector<std::vector<glm::dvec3>> nodes, velocity;  // of the present moment
  double wd = 0;

  Impl(std::vector<Blade> b, const BladeOptions& bo, const SeasonOptions& so, const TissueOptions& to, const ColourOptions& co)
      : blades(std::move(b)), blade_options(bo), season(so), tissue(to), colour(co), curves(so), pigments(co.model) {
    models.reserve(blades.size());
    for (const Blade& blade : blades) models.emplace_back(blade, blade_options, tissue, curves);
    shapes.resize(blades.size());
    nodes.resize(blades.size());
    velocity.resize(blades.size());
    for (std::size_t i = 0; i < blades.size(); ++i) {
      const Shape rod = models[i].initial_rod();
      const std::vector<double> theta = models[i].inclinations(rod.a);
      models[i].lay_out(0.0, [&](int k) { return theta[std::size_t(k)]; }, nodes[i]);
      velocity[i].assign(nodes[i].size(), glm::dvec3(0));
      if (tissue.motion == Motion::rod) shapes[i] = rod;
      else polar(i);
    }
  }

  void polar(std::size_t i) {
    radius_m.resize(blades.size());
    azimuth_rad.resize(blades.size());
    h_over_H.resize(blades.size());
    double H = 0;
    for (const glm::dvec3& p : nodes[i]) H = std::max(H, p.z);
    for (const glm::dvec3& p : nodes[i]) {
      const glm::dvec3 d = p - blades[i].root_m;
      const double r = glm::length(d);
      radius_m[i].push_back(r);
      azimuth_rad[i].push_back(r > 0 ? std::atan2(d.y, d.x) : 0.0);
      shapes[i].a.push_back(r > 0 ? std::acos(std::clamp(d.z / r, -1.0, 1.0)) : 0.0);
      h_over_H[i].push_back(p.z / H);
    }
  }

  std::vector<glm::dvec3> place(std::size_t i, double at_wd, const Shape& x) const {
    std::vector<glm::dvec3> out;
    if (tissue.motion == Motion::rod) {
      const std::vector<double> theta = models[i].inclinations(x.a);
      models[i].lay_out(at_wd, [&](int k) { return theta[std::size_t(k)]; }, out);
      return out;
    }
    for (std::size_t k = 0; k < x.a.size(); ++k) {
      const double arc = double(k) / double(x.a.size() - 1);
      const double r = radius_m[i][k] * (1 + tissue.shrink_length * shrink_progress(tissue, models[i].water(at_wd, arc)));
      const double az = azimuth_rad[i][k];
      glm::dvec3 p = blades[i].root_m + r * glm::dvec3(std::sin(x.a[k]) * std::cos(az), std::sin(x.a[k]) * std::sin(az), std::cos(x.a[k]));
      if (k > 0) p.z = std::max(p.z, kGround_m);
      out.push_back(p);
    }
    return out;
  }

  Shape rate(std::size_t i, double at_wd, const Shape& x) const {
    return tissue.motion == Motion::rod ? models[i].rod_rate(at_wd, x) : models[i].paper_rate(at_wd, x, h_over_H[i]);
  }

  void advance(double to_wd) {
    const double days = (to_wd - wd) * season.length_days;
    // At least the user's steps; never longer than a third of the response time, where the explicit midpoint rule is stable.
    const double per_day = std::max(season.steps_per_day, 3 / tissue.response_days);
    const int steps = std::max(1, int(std::ceil(days * per_day - 1e-9)));
    const double h_days = days / steps, h_wd = (to_wd - wd) / steps;
    parallel_for(blades.size(), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Shape& x = shapes[i];
        for (int step = 0; step < steps; ++step) {  // explicit midpoint, O(h^2)
          const double t = wd + step * h_wd;
          const Shape middle = axpy(x, 0.5 * h_days, rate(i, t, x));
          x = axpy(x, h_days, rate(i, t + 0.5 * h_wd, middle));
        }
        const Shape last = axpy(x, -1e-3, rate(i, to_wd, x));  // a thousandth of a day ago
        std::vector<glm::dvec3> now = place(i, to_wd, x);
        const std::vector<glm::dvec3> before = place(i, to_wd - 1e-3 / season.length_days, last);
        for (std::size_t k = 0; k < now.size(); ++k) velocity[i][k] = (now[k] - before[k]) / 1e-3;
        nodes[i] = std::move(now);
      }
    });
    wd = to_wd;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (const glm::dvec3& p : nodes[i])
        if (!std::isfinite(p.x + p.y + p.z))
          throw SolverFailure("blade " + std::to_string(i) + ": position is not finite at wd = " + std::to_string(wd) +
                              "; more season.steps_per_day may help");
  }

  void frames(std::size_t i, BladeState& s) const;
  void material(std::size_t i, BladeState& s) const;
};

void BladeMotion::Impl::frames(std::size_t i, BladeState& s) const {
  const std::vector<glm::dvec3>& p = nodes[i];
  const std::size_t n = p.size(), base = i * n;
  glm::dvec3 side(-std::sin(blades[i].azimuth_rad), std::cos(blades[i].azimuth_rad), 0);
  for (std::size_t k = 0; k < n; ++k) {
    const glm::dvec3 t = glm::normalize(p[std::min(k + 1, n - 1)] - p[k == 0 ? 0 : k - 1]);
    side = glm::normalize(side - glm::dot(side, t) * t);  // carried along the blade without turning about it
    const double twist = blades[i].twist_rad * double(k) / double(n - 1);
    s.node_m[base + k] = p[k];
    s.velocity_m_day[base + k] = velocity[i][k];
    s.tangent[base + k] = t;
    s.side[base + k] = std::cos(twist) * side + std::sin(twist) * glm::cross(t, side);
  }
}

void BladeMotion::Impl::material(std::size_t i, BladeState& s) const {
  const Blade& b = blades[i];
  const std::size_t n = nodes[i].size(), base = i * n;
  for (std::size_t k = 0; k < n; ++k) {
    const double arc = double(k) / double(n - 1), w = models[i].water(wd, arc);
    const double g = shrink_progress(tissue, w);
    const double c = curves.spot_chlorophyll(wd, b.onset, arc);
    const TissueState ts = tissue_state(tissue, w);
    const std::size_t j = base + k;
    s.half_width_m[j] = float(0.5 * b.width_m * width_profile(blade_options.form, arc) * (1 + tissue.shrink_width * g));
    s.thickness_m[j] = float(b.thickness_m * (1 + tissue.shrink_thickness * g));
    s.fold_rad[j] = float(blade_options.form == BladeForm::cone ? 0.0 : b.fold_rad + (1.15 - b.fold_rad) * 0.6 * g);  // rolls up as it dries
    s.water[j] = float(w);
    s.chlorophyll[j] = float(c);
    s.strain_vein[j] = float(ts.strain_vein);
    s.strain_mesophyll[j] = float(ts.strain_mesophyll);
    s.stress_vein_MPa[j] = float(ts.stress_vein_MPa);
    s.stress_mesophyll_MPa[j] = float(ts.stress_mesophyll_MPa);
    s.diffuse[j] = glm::min(pigments(c) * float(b.brightness), glm::vec3(1.0f));
    s.specular[j] = float(colour.specular * (0.5 + 0.5 * w));  // the cuticle's gloss dulls as it dries
  }
}

BladeMotion::BladeMotion(std::vector<Blade> blades, const BladeOptions& blade_options, const SeasonOptions& season,
                         const TissueOptions& tissue, const ColourOptions& colour)
    : impl_(std::make_unique<Impl>(std::move(blades), blade_options, season, tissue, colour)) {}
BladeMotion::~BladeMotion() = default;
BladeMotion::BladeMotion(BladeMotion&&) noexcept = default;
BladeMotion& BladeMotion::operator=(BladeMotion&&) noexcept = default;

void BladeMotion::advance_to(double wd) {
  if (!(wd >= impl_->wd && wd <= 1))
    throw InvalidInput("BladeMotion::advance_to: wd = " + std::to_string(wd) + " is outside " + std::to_string(impl_->wd) + "..1");
  if (wd > impl_->wd) impl_->advance(wd);
}

double BladeMotion::wd() const { return impl_->wd; }
const std::vector<Blade>& BladeMotion::blades() const { return impl_->blades; }

BladeState BladeMotion::state() const {
  BladeState s;
  s.form = impl_->blade_options.form;
  s.segments = impl_->blade_options.segments;
  s.wd = impl_->wd;
  s.time_days = impl_->wd * impl_->season.length_days;
  s.chlorophyll_fresh_ug_cm2 = impl_->colour.chlorophyll_fresh_ug_cm2;
  const std::size_t n = impl_->blades.size() * std::size_t(s.segments + 1);
  s.node_m.resize(n);
  s.velocity_m_day.resize(n);
  s.tangent.resize(n);
  s.side.resize(n);
  for (auto* v : {&s.half_width_m, &s.thickness_m, &s.fold_rad, &s.water, &s.chlorophyll, &s.stress_vein_MPa,
                  &s.stress_mesophyll_MPa, &s.strain_vein, &s.strain_mesophyll, &s.specular})
    v->resize(n);
  s.diffuse.resize(n);
  parallel_for(impl_->blades.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      impl_->frames(i, s);
      impl_->material(i, s);
    }
  });
  return s;
}

}  // namespace witherfield::grass
