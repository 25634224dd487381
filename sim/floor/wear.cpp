#include "sim/floor/wear.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <mutex>

#include "sim/core/parallel.hpp"
#include "sim/floor/room.hpp"

namespace witherfield::floor {
namespace {

constexpr double kThroughBand = 0.3;  // a layer goes between 1 - this and 1 + this of the work that its thickness takes
const glm::dvec3 kDirtColour{0.060, 0.048, 0.036};
constexpr double kJointShade = 0.10;  // of the colour, in a joint

double smoothstep(double lo, double hi, double x) {
  const double s = std::clamp((x - lo) / (hi - lo), 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

double thickness_m(const Layer& l, double finish) { return 1e-6 * l.thickness_um * finish; }
double work_through(const Layer& l, double finish) {
  return l.wear_coefficient > 0 ? thickness_m(l, finish) * l.hardness_Pa / l.wear_coefficient : 1e300;
}

/// Smooth noise, mean 0, about -1..1, with patches of the given size.
double noise(const FloorPattern& p, glm::dvec2 at, glm::dvec2 patch_m, std::uint32_t which) {
  const double x = at.x / patch_m.x, y = at.y / patch_m.y;
  const double i = std::floor(x), j = std::floor(y), u = smoothstep(0, 1, x - i), v = smoothstep(0, 1, y - j);
  const auto value = [&](double a, double b) {
    return 2 * piece_random(p, (std::uint64_t(std::uint32_t(std::int32_t(b))) << 32) | std::uint32_t(std::int32_t(a)), which) - 1;
  };
  return (1 - v) * ((1 - u) * value(i, j) + u * value(i + 1, j)) + v * ((1 - u) * value(i, j + 1) + u * value(i + 1, j + 1));
}

double even(double u) { return 1.7320508 * (2 * u - 1); }  // mean 0, standard deviation 1

}  // namespace

double wear_depth_m(const std::vector<Layer>& layers, double work, double finish, double hardness) {
  double depth = 0;
  for (std::size_t n = 0; n + 1 < layers.size(); ++n) {
    const double through = work_through(layers[n], finish);
    if (work < through) return depth + work * layers[n].wear_coefficient / layers[n].hardness_Pa;
    work -= through;
    depth += thickness_m(layers[n], finish);
  }
  return depth + work * layers.back().wear_coefficient / (layers.back().hardness_Pa * hardness);
}

Look look_of(const std::vector<Layer>& layers, double work, double finish, double hardness) {
  Look look;
  double spent = 0;  // work that the layers above took
  for (std::size_t n = 0; n < layers.size(); ++n) {
    const Layer& l = layers[n];
    const bool last = n + 1 == layers.size();
    const double aged = 1 - std::exp(-std::max(0.0, work - spent) /
                                     (l.gloss_hits * kReferenceHit_J_m2 * (last ? hardness : finish)));
    const double shown = n == 0 ? 1 : smoothstep((1 - kThroughBand) * spent, (1 + kThroughBand) * spent, work);
    look.gloss += shown * (l.gloss_new + aged * (l.gloss_worn - l.gloss_new) - look.gloss);
    look.colour += shown * (l.colour + aged * (l.colour_worn - l.colour) - look.colour);
    look.dirt_hold += shown * (l.dirt_hold - look.dirt_hold);
    spent += work_through(l, finish);
  }
  return look;
}

double dirt_of(const SoilOptions& soil, double brought, double footfalls, double days) {
  const double loss = soil.rubbed * footfalls + soil.mopped_per_day * days;
  const double m = loss > 1e-6 ? brought * -std::expm1(-loss) / loss : brought;
  return -std::expm1(-m);
}

struct Finish::Place {
  float finish, hardness, brightness, height_m, joint, extra_work;  // extra_work: factor of the nosing
  bool inside;
};

Finish::~Finish() = default;

Finish::Finish(const FloorOptions& options) : options_(options) {
  const MaterialOptions& m = options.material;
  for (const FloorField& grid : make_grids(options)) {
    std::vector<Place> places(grid.cells());
    const std::size_t tread = places_.size();
    parallel_for(std::size_t(grid.ny), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t j = begin; j < end; ++j)
        for (int i = 0; i < grid.nx; ++i) {
          const glm::dvec2 at = grid.centre_m(i, int(j));
          const FloorPiece piece = piece_at(m.pattern, at);
          const auto of_piece = [&](std::uint32_t which) { return even(piece_random(m.pattern, piece.id, which)); };
          Place& p = places[j * std::size_t(grid.nx) + std::size_t(i)];
          // Finish is put on by hand along the pieces: patches longer than wide, and finer ones in them.
          const double uneven = 0.7 * noise(m.pattern, piece.local_m + 7.0 * of_piece(10), {0.30, 0.08}, 1) +
                                0.5 * noise(m.pattern, piece.local_m + 3.0 * of_piece(11), {0.06, 0.018}, 2);
          p.finish = float(std::max(0.3, 1 + m.finish_sd * (1.2 * uneven + 0.5 * of_piece(12))));
          p.hardness = float(std::max(0.3, 1 + m.piece_hardness_sd * of_piece(13)));
          p.brightness = float(std::max(0.3, 1 + m.piece_brightness_sd * of_piece(14)));
          const double cover = std::clamp(0.5 - piece.edge_m / grid.spacing_m, 0.0, 1.0);
          p.joint = float(cover * std::min(1.0, m.pattern.joint_m / grid.spacing_m));
          p.height_m = float(m.piece_level_sd_m * of_piece(15) - p.joint * m.joint_depth_m);
          p.extra_work = 1;
          p.inside = options.stairs || contains(options.room.outline_m, at);
          if (options.stairs) {
            const StairOptions& s = *options.stairs;
            p.height_m += float(double(tread + 1) * s.rise_m);
            if (s.nosing_m > 0)
              p.extra_work = float(1 + (s.nosing_factor - 1) * std::exp(-(at.y - grid.origin_m.y) / s.nosing_m));
          }
        }
    });
    places_.push_back(std::move(places));
  }
}

Finish::Change Finish::apply(const Wear& wear, double days, std::vector<FloorField>& floors) const {
  const std::vector<Layer>& layers = options_.material.layers;
  Change change;
  std::mutex guard;
  for (std::size_t k = 0; k < floors.size(); ++k) {
    FloorField& f = floors[k];
    const bool first = !f.has("diffuse");
    for (const char* name : {"footfalls", "dose_N_s_m2", "slide_m", "wear_depth_um", "gloss", "dirt", "height_m", "diffuse"})
      f.make(name);
    float *footfalls = f.at("footfalls").data(), *dose = f.at("dose_N_s_m2").data(), *slide = f.at("slide_m").data(),
          *depth = f.at("wear_depth_um").data(), *gloss = f.at("gloss").data(), *dirt = f.at("dirt").data(),
          *height = f.at("height_m").data(), *diffuse = f.at("diffuse").data();
    const float *from[3] = {wear.floors[k].at("footfalls").data(), wear.floors[k].at("dose_N_s_m2").data(),
                            wear.floors[k].at("slide_m").data()};
    parallel_for(std::size_t(f.ny), 8, [&](std::size_t begin, std::size_t end) {
      Change mine;
      const auto set = [&](float& old, double now, bool may_fall) {
        mine.finite = mine.finite && std::isfinite(now);
        mine.fell = mine.fell || (!may_fall && !first && float(now) < old);
        old = float(now);
      };
      for (std::size_t n = begin * std::size_t(f.nx); n < end * std::size_t(f.nx); ++n) {
        const Place& p = places_[k][n];
        const double in = p.inside ? 1 : 0;
        set(footfalls[n], in * from[0][n], false);
        set(dose[n], in * from[1][n], false);
        set(slide[n], in * from[2][n], false);
        const double work = in * p.extra_work * wear.work_J_m2[k][n];
        const double worn_m = wear_depth_m(layers, work, p.finish, p.hardness);
        set(depth[n], 1e6 * worn_m, false);
        set(height[n], p.height_m - worn_m, true);
        const Look look = look_of(layers, work, p.finish, p.hardness);
        set(gloss[n], look.gloss * (1 - p.joint), true);
        const double soiled = dirt_of(options_.soil, in * wear.soil[k][n], footfalls[n], days);
        set(dirt[n], soiled, true);
        glm::dvec3 c = look.colour * double(p.brightness);
        c = glm::mix(c, kDirtColour, soiled * look.dirt_hold);
        c *= 1 - (1 - kJointShade) * p.joint;
        for (int a = 0; a < 3; ++a) {
          const double now = std::clamp(c[a], 0.0, 1.0);
          if (!first) mine.diffuse_max = std::max(mine.diffuse_max, std::abs(now - diffuse[3 * n + std::size_t(a)]));
          set(diffuse[3 * n + std::size_t(a)], now, true);
        }
      }
      const std::lock_guard<std::mutex> lock(guard);
      change.diffuse_max = std::max(change.diffuse_max, mine.diffuse_max);
      change.fell = change.fell || mine.fell;
      change.finite = change.finite && mine.finite;
    });
  }
  return change;
}

}  // namespace witherfield::floor
