// A worn flight of stairs between two walls of masonry, open to the sky.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "pov/floor_text.hpp"
#include "pov/png.hpp"
#include "pov/room_scene.hpp"
#include "pov/scene_parts.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

constexpr double kUnit = 100;
constexpr double kUnderRiser_m = 0.03;  // a tread runs on below the next riser
constexpr double kLanding_m = 1.6;

void check(double value, double low, double high, const std::string& what) {
  if (!(value >= low && value <= high))
    throw InvalidInput("stair scene: " + what + " must be " + std::to_string(low) + " to " + std::to_string(high) +
                       ", got " + std::to_string(value));
}

void check_input(const StairSceneInput& in) {
  if (in.treads.empty()) throw InvalidInput("stair scene '" + in.still.name + "': there must be at least one tread, got 0");
  check_still(in.still, "stair scene");
  check(in.going_m, 0.1, 2, "going_m");
  check(in.rise_m, 0.02, 1, "rise_m");
  check(in.width_m, 0.3, 50, "width_m");
  check(in.wall_height_m, 0.2, 20, "wall_height_m");
  check(in.nosing_m, 0, std::min(0.05, 0.4 * in.rise_m), "nosing_m");
  for (int c = 0; c < 3; ++c) check(in.wall_rgb[c], 0, 0.95, "wall_rgb");
  for (std::size_t k = 0; k < in.treads.size(); ++k)
    check_floor(in.treads[k], in.look, "stair scene '" + in.still.name + "': tread " + std::to_string(k));
}

/// The surface of one step: from below the next riser forward over the tread, round the edge and down the riser. The worn edge
/// lies lower and further back, and is rounder.
class Step {
 public:
  Step(const StairSceneInput& in, std::size_t k, const FloorMaps& maps) : in_(in), maps_(maps), k_(k) {
    nx_ = std::clamp(maps.width / 2, 16, 320);
    depth_m_ = in.going_m + kUnderRiser_m;
    for (int j = 0; j <= kTop; ++j) {  // finer towards the edge
      const double s = double(j) / kTop;
      row(1 - s * (1.6 - 0.6 * s), 0);
    }
    for (int j = 1; j <= kEdge; ++j) row(0, 0.5 * 3.14159265 * j / kEdge);
    for (int j = 1; j <= kFront; ++j) row(0, 0.5 * 3.14159265 + double(j) / kFront);
  }
  std::string mesh_text() const {
    const int rows = int(points_.size()) / (nx_ + 1);
    Text t;
    t << "mesh2{vertex_vectors{" << points_.size();
    for (const glm::dvec3& p : points_) t << "," << flip(p, kUnit);
    t << "}\nnormal_vectors{" << points_.size();
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i <= nx_; ++i) {
        const glm::dvec3 across = at(std::min(i + 1, nx_), j) - at(std::max(i - 1, 0), j),
                         down = at(i, std::min(j + 1, rows - 1)) - at(i, std::max(j - 1, 0));
        t << "," << flip(glm::normalize(glm::cross(down, across)));
      }
    t << "}\nface_indices{" << 2 * nx_ * (rows - 1);
    for (int j = 0; j + 1 < rows; ++j)
      for (int i = 0; i < nx_; ++i) {
        const int a = j * (nx_ + 1) + i, b = a + nx_ + 1;
        t << ",<" << a << "," << a + 1 << "," << b << ">,<" << a + 1 << "," << b + 1 << "," << b << ">";
      }
    t << "}}\n";
    return t.str();
  }

 private:
  static constexpr int kTop = 44, kEdge = 8, kFront = 8;

  const glm::dvec3& at(int i, int j) const { return points_[std::size_t(j) * std::size_t(nx_ + 1) + std::size_t(i)]; }

  /// Height of the maps at x, and y behind the front edge.
  double height(double x, double y) const {
    const double u = std::clamp(x / in_.width_m * maps_.width - 0.5, 0.0, maps_.width - 1.0),
                 v = std::clamp((1 - y / in_.going_m) * maps_.height - 0.5, 0.0, maps_.height - 1.0);
    const int i = std::min(int(u), maps_.width - 2), j = std::min(int(v), maps_.height - 2);
    const auto h = [&](int a, int b) { return double(maps_.relief_m[std::size_t(b) * std::size_t(maps_.width) + std::size_t(a)]); };
    return glm::mix(glm::mix(h(i, j), h(i + 1, j), u - i), glm::mix(h(i, j + 1), h(i + 1, j + 1), u - i), v - j);
  }

  /// @param back share of the tread's depth behind the edge; @param angle 0 on the tread, to pi/2 round the edge, then beyond
  /// it the share of the riser.
  void row(double back, double angle) {
    const double y0 = double(k_) * in_.going_m, foot = double(k_) * in_.rise_m - kUnderRiser_m;
    for (int i = 0; i <= nx_; ++i) {
      const double x = in_.width_m * i / nx_;
      const double edge = height(x, 0), worn = std::max(0.0, double(k_ + 1) * in_.rise_m - edge);
      const double round = std::min(in_.nosing_m + 0.8 * worn, 0.35 * in_.rise_m), set_back = 0.35 * worn;
      const double turned = std::min(angle, 0.5 * 3.14159265), below = std::max(0.0, angle - 0.5 * 3.14159265);
      glm::dvec3 p{x, y0 + set_back + round * (1 - std::sin(turned)), 0};
      p.y += back * (depth_m_ - set_back - round);
      p.z = height(x, p.y - y0) - round * (1 - std::cos(turned));
      // Back on the plane of the unworn riser at its foot.
      p.z = glm::mix(p.z, foot, below);
      p.y = glm::mix(p.y, y0, below * below);
      points_.push_back(p);
    }
  }

  const StairSceneInput& in_;
  const FloorMaps& maps_;
  std::size_t k_;
  int nx_ = 16;
  double depth_m_ = 0;
  std::vector<glm::dvec3> points_;
};

/// Risers are not worn: the stone's mean colour, dressed with a chisel. (Maps are laid from above and would streak here.)
std::string riser_text(const FloorMaps& maps) {
  glm::dvec3 mean(0.0);
  for (const glm::vec3& c : maps.albedo) mean += glm::dvec3(c) / double(maps.albedo.size());
  Text t;
  t << "#declare Riser=texture{pigment{granite color_map{[0 rgb" << mean * 0.62 << "][0.6 rgb" << mean * 1.05 << "][1 rgb"
    << mean * 1.15 << "]} scale 16} normal{granite 0.15 scale 8} finish{diffuse 1 ambient Fill}}\n";
  return t.str();
}

/// Side walls, the wall behind the landing, landing and ground, of rough masonry.
std::string masonry_text(const std::filesystem::path& folder, const std::string& stem, const StairSceneInput& in) {
  const double flight = double(in.treads.size()) * in.going_m, top = double(in.treads.size()) * in.rise_m;
  const double length = flight + 2.5 + kLanding_m + 0.6, tall = top + in.wall_height_m;
  const MapArea area{{0, 0}, {length, tall}};
  const FloorMaps maps = make_masonry_maps(in.wall_rgb, area.size_m(), map_pixels(in.look, in.still.width_px) / 2 + 256, in.look.pattern.seed);
  const FloorFiles files = write_floor_maps(folder, stem + "_wall", maps);
  const double rough = 0.045;  // height of the relief
  Text t;
  t << "#declare Masonry=texture{pigment{image_map{png \"" << files.albedo << "\" gamma 1.0 interpolate 2}} rotate x*90 scale "
    << glm::dvec3(length, 1, tall) * kUnit << "}\n"
    << "#declare MasonryWall=height_field{png \"" << files.height << "\" gamma 1.0 smooth scale " << glm::dvec3(length, rough, tall) * kUnit
    << " texture{Masonry finish{diffuse 1 ambient Fill specular 0.03 roughness 0.1}}}\n";
  // The height field lies in x, z and rises along y: x becomes the way up the stairs, z becomes height, y points into the flight.
  const double start = -2.5;
  t << "object{MasonryWall matrix<0,0,1, 1,0,0, 0,1,0, " << -0.5 * rough * kUnit << ",0," << start * kUnit << ">}\n"
    << "object{MasonryWall matrix<0,0,1, -1,0,0, 0,1,0, " << (in.width_m + 0.5 * rough) * kUnit << ",0," << start * kUnit << ">}\n"
    << "object{MasonryWall matrix<1,0,0, 0,0,-1, 0,1,0, -50,0," << (flight + kLanding_m) * kUnit << ">}\n";
  for (const double x : {-0.6, in.width_m})  // what the relief stands on; the copings
    t << "box{" << glm::dvec3(x + (x < 0 ? 0.0 : 0.02), -0.5, start) * kUnit << "," << glm::dvec3(x + 0.58, tall, flight + kLanding_m + 0.5) * kUnit
      << " texture{Coping}}\n";
  t << "box{" << glm::dvec3(-1, -0.5, flight + kLanding_m + 0.02) * kUnit << "," << glm::dvec3(in.width_m + 1, tall, flight + kLanding_m + 0.5) * kUnit
    << " texture{Coping}}\n"
    << "box{" << glm::dvec3(-1, top - 1, flight) * kUnit << "," << glm::dvec3(in.width_m + 1, top - 0.003, flight + kLanding_m + 0.1) * kUnit
    << " texture{Coping}}\n"
    << "box{" << glm::dvec3(-1, -0.5, start - 3) * kUnit << "," << glm::dvec3(in.width_m + 1, 0, 0.05) * kUnit << " texture{Coping}}\n";
  return t.str();
}

std::string head_and_light(const StairSceneInput& in, const std::string& stem) {
  const glm::dvec3 sun = in.still.sun.direction(), toward{sun.x, sun.z, sun.y};
  const glm::dvec3 side = glm::normalize(glm::cross(toward, glm::dvec3(0.01, 1, 0))), up = glm::cross(side, toward);
  Text t;
  t << head_text({in.still.width_px, in.still.height_px, in.still.exposure, "room", in.still.camera.aperture_m > 0, false}, stem)
    << "#version 3.7;\n#ifndef(QUALITY) #declare QUALITY=1; #end\n#default{finish{ambient 0 diffuse 1}}\n"
    << "global_settings{assumed_gamma 1.0 max_trace_level 5";
  if (!in.film)
    t << " radiosity{pretrace_start 0.08 pretrace_end (QUALITY=0?0.04:0.02) count (QUALITY=0?40:(QUALITY=1?100:250)) nearest_count 8 error_bound 0.6 "
         "recursion_limit 2 minimum_reuse 0.012 low_error_factor 0.6 gray_threshold 0 brightness 1 normal off}";
  t << "}\n#declare Fill=rgb" << (in.film ? glm::dvec3(0.42, 0.46, 0.52) : glm::dvec3(0.0)) << ";\n"
    << camera_text(in.still.camera, kUnit) << "sky_sphere{pigment{gradient y color_map{[0 rgb<1.7,1.75,1.8>][1 "
    << "rgb<1.0,1.2,1.5>]}}}\nlight_source{" << toward * 1e5 << " rgb<5.2,4.6,3.8> parallel point_at 0 area_light "
    << side * 930.0 << "," << up * 930.0 << ",3,3 adaptive 1 circular" << (in.film ? "" : " jitter") << "}\n"
    << "#declare Coping=texture{pigment{granite color_map{[0 rgb" << in.wall_rgb * 0.75 << "][1 rgb" << in.wall_rgb * 1.1
    << "]} scale 14} normal{granite 0.12 scale 9} finish{diffuse 1 ambient Fill}}\n";
  return t.str();
}

}  // namespace

std::filesystem::path write_stair_scene(const std::filesystem::path& folder, const StairSceneInput& in,
                                        const Progress& progress) {
  check_input(in);
  make_folder(folder);
  const std::string stem = in.still.name + "_stairs";
  Text t;
  t << head_and_light(in, stem);
  FloorLook look = in.look;
  for (std::size_t k = 0; k < in.treads.size(); ++k) {
    if (progress) progress("writing the stairs", double(k) / double(in.treads.size()));
    // Its own lower left corner is the front edge's left end.
    const MapArea area{in.treads[k].origin_m, in.treads[k].origin_m + glm::dvec2(in.width_m, in.going_m)};
    look.pattern.seed = in.look.pattern.seed + k;  // every step is cut from a block of its own
    const int px = in.look.map_px > 0 ? in.look.map_px : std::clamp(in.still.width_px, 128, 1024);
    const FloorMaps maps = make_floor_maps(in.treads[k], look, area, map_size(area, px), double(k + 1) * in.rise_m);
    const std::string name = stem + "_" + std::to_string(k);
    const FloorFiles files = write_floor_maps(folder, name, maps);
    write_file(folder / (name + ".inc"), Step(in, k, maps).mesh_text());
    const MapArea place{{0, double(k) * in.going_m}, {in.width_m, double(k + 1) * in.going_m}};
    const std::string texture = "Tread" + std::to_string(k);
    t << floor_texture_text(files, look, place, kUnit, texture) << riser_text(maps) << "object{#include \"" << name << ".inc\"\n texture{slope{y} texture_map{[0.62 Riser][0.80 " << texture
      << "]}} interior{ior 1.5}}\n";
  }
  t << masonry_text(folder, stem, in);
  const auto path = folder / (stem + ".pov");
  write_file(path, t.str());
  if (progress) progress("writing the stairs", 1);
  return path;
}

}  // namespace witherfield::pov
