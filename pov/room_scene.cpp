#include "pov/room_scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "pov/floor_text.hpp"
#include "pov/room_walls.hpp"
#include "pov/scene_parts.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

constexpr double kUnit = 100;  // POV-Ray units per metre: centimetres

void check(double value, double low, double high, const std::string& what) {
  if (!(value >= low && value <= high))
    throw InvalidInput("room scene: " + what + " must be " + std::to_string(low) + " to " + std::to_string(high) +
                       ", got " + std::to_string(value));
}

void check_polygon(const std::vector<glm::dvec2>& p, const std::string& what) {
  if (p.size() < 3)
    throw InvalidInput("room scene: " + what + " must have at least 3 corners, got " + std::to_string(p.size()));
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!(glm::length(p[(i + 1) % p.size()] - p[i]) > 1e-6))
      throw InvalidInput("room scene: " + what + ": corners " + std::to_string(i) + " and " +
                         std::to_string((i + 1) % p.size()) + " are the same place");
  if (!(std::abs(signed_area(p)) > 1e-6)) throw InvalidInput("room scene: " + what + " has no area");
}

void check_input(const RoomSceneInput& in) {
  if (!in.floor) throw InvalidInput("room scene '" + in.still.name + "' has no floor");
  check_floor(*in.floor, in.look, "room scene '" + in.still.name + "': floor");
  check_still(in.still, "room scene");
  check_polygon(in.outline_m, "the room's outline");
  check(in.wall_height_m, 1.8, 20, "wall_height_m");
  check(in.haze, 0, 1, "haze");
  check(in.lamps, 0, 10, "lamps");
  for (int c = 0; c < 3; ++c) check(in.wall_rgb[c], 0, 0.95, "wall_rgb");
  for (std::size_t i = 0; i < in.openings.size(); ++i) {
    const std::string name = "opening " + std::to_string(i);
    check(in.openings[i].sill_m, 0, in.wall_height_m, name + ": sill_m");
    check(in.openings[i].height_m, 0.05, in.wall_height_m - in.openings[i].sill_m, name + ": height_m");
    check(glm::length(in.openings[i].b_m - in.openings[i].a_m), 0.1, 100, name + ": width in m");
  }
  for (std::size_t i = 0; i < in.obstacles.size(); ++i) {
    check_polygon(in.obstacles[i].outline_m, "obstacle " + std::to_string(i));
    check(in.obstacles[i].height_m, 0.1, in.wall_height_m, "obstacle " + std::to_string(i) + ": height_m");
  }
  for (std::size_t i = 0; i < in.pictures.size(); ++i) {
    const std::string name = "picture " + std::to_string(i);
    check(in.pictures[i].width_m, 0.05, 10, name + ": width_m");
    check(in.pictures[i].height_m, 0.05, 10, name + ": height_m");
    check(in.pictures[i].middle_m, 0, in.wall_height_m, name + ": middle_m");
  }
}

/// Textures of all but the floor. Fill stands in for radiosity in films: light from below the windows' sills is weaker.
std::string textures_text(const RoomSceneInput& in) {
  Text t;
  const glm::dvec3 low = in.film ? glm::dvec3(0.30, 0.28, 0.25) : glm::dvec3(0), high = low * 1.25;
  const auto paint = [&](const glm::dvec3& fill) {
    return (Text() << "pigment{rgb" << in.wall_rgb << "} finish{diffuse 1 ambient rgb" << fill << "}").str();
  };
  t << "#declare Fill=rgb" << low << ";\n"
    << "#declare WallPaint=texture{gradient y texture_map{[0 " << paint(low) << "][1 " << paint(high) << "]} scale "
    << (in.wall_height_m + 1) * kUnit << " translate -" << 0.5 * kUnit << "*y}\n"
    << "#declare Ceiling=texture{pigment{rgb 0.80} finish{diffuse 1 ambient rgb" << high << "}}\n"
    << "#declare White=texture{pigment{rgb<0.78,0.77,0.74>} finish{diffuse 1 ambient Fill specular 0.12 roughness 0.02}}\n"
    << "#declare DoorPaint=texture{pigment{rgb<0.20,0.25,0.23>} finish{diffuse 0.95 ambient Fill specular 0.15 roughness "
       "0.02}}\n"
    << "#declare Brass=texture{pigment{rgb<.75,.58,.28>} finish{diffuse .3 ambient Fill specular .7 roughness .01 "
       "reflection{.4 metallic}}}\n"
    << "#declare Frame=texture{pigment{rgb<0.055,0.042,0.034>} finish{diffuse 1 ambient Fill specular 0.2 roughness 0.02}}\n"
    << "#declare Threshold=texture{pigment{rgb<0.16,0.10,0.06>} finish{diffuse 1 ambient Fill}}\n"
    << "#declare Steel=texture{pigment{rgb 0.10} finish{diffuse 0.8 ambient Fill specular 0.3 roughness 0.03}}\n"
    << "#declare Furniture=texture{pigment{wood turbulence 0.06 color_map{[0 rgb<0.30,0.185,0.095>][0.8 "
       "rgb<0.235,0.135,0.065>][1 rgb<0.20,0.11,0.05>]} scale <11,11,11> rotate <2,86,0>} finish{diffuse 1 ambient Fill "
       "specular 0.12 roughness 0.03 reflection{0,0.25 fresnel on} conserve_energy}}\n"
    << "#declare Chair=texture{pigment{rgb<0.115,0.058,0.030>} finish{diffuse 1 ambient Fill specular 0.18 roughness 0.02}}\n"
    << "#declare Cabinet=texture{pigment{rgb<0.34,0.35,0.33>} finish{diffuse 0.95 ambient Fill specular 0.1 roughness 0.03}}\n"
    << "#declare Screen=texture{pigment{rgb 0.022} finish{diffuse 1 ambient Fill specular 0.2 roughness 0.02 reflection{0,0.3 fresnel on} "
       "conserve_energy}}\n"
    << "#declare Paper=texture{pigment{rgb<0.80,0.79,0.75>} finish{diffuse 1 ambient Fill}}\n";
  return t.str();
}

/// With haze a view passes in and out of several shafts of light before it comes to the wall: each counts as a level.
std::string settings_text(bool film, bool haze) {
  Text t;
  t << "#version 3.7;\n#ifndef(QUALITY) #declare QUALITY=1; #end\n#default{finish{ambient 0 diffuse 1}}\n"
    << "global_settings{assumed_gamma 1.0 max_trace_level " << (haze ? 40 : 6);
  if (!film)
    t << "\n  radiosity{pretrace_start 0.08 pretrace_end (QUALITY=0?0.04:0.02) count (QUALITY=0?70:(QUALITY=1?120:300)) "
         "nearest_count 14 error_bound (QUALITY=2?0.5:0.9) recursion_limit 2 minimum_reuse 0.03 low_error_factor 0.8 "
         "gray_threshold 0 brightness 1 normal off}";
  t << "}\n#macro JITTER() " << (film ? "" : "jitter ") << "#end\n";
  return t.str();
}

}  // namespace

std::filesystem::path write_room_scene(const std::filesystem::path& folder, const RoomSceneInput& in,
                                       const Progress& progress) {
  check_input(in);
  const std::vector<Wall> walls = walls_of(in);
  make_folder(folder);
  const auto report = [&](double done) {
    if (progress) progress("writing the room", done);
  };
  report(0);
  MapArea area{in.outline_m[0], in.outline_m[0]};
  for (const glm::dvec2& p : in.outline_m) area.low_m = glm::min(area.low_m, p), area.high_m = glm::max(area.high_m, p);
  const FloorMaps maps =
      make_floor_maps(*in.floor, in.look, area, map_size(area, map_pixels(in.look, in.still.width_px)));
  report(0.4);
  const std::string stem = in.still.name + "_room";
  const FloorFiles files = write_floor_maps(folder, stem, maps);
  report(0.9);
  Text t;
  t << head_text({in.still.width_px, in.still.height_px, in.still.exposure, "room", in.still.camera.aperture_m > 0, false},
                 stem)
    << settings_text(in.film, in.haze > 0) << camera_text(in.still.camera, kUnit) << textures_text(in)
    << floor_texture_text(files, in.look, area, kUnit) << height_field_text(files, area, kUnit);
  // Maps cover the box around the outline; what lies beyond the walls is cut away.
  if (in.outline_m.size() != 4 || std::abs(0.5 * std::abs(signed_area(in.outline_m)) - area.size_m().x * area.size_m().y) > 1e-6)
    t << " clipped_by{" << prism_text(in.outline_m, -1, 1, kUnit) << "}}";
  t << " texture{FloorTexture} interior{ior 1.5}}\n"
    << walls_text(in, walls, kUnit) << obstacles_text(in, kUnit) << pictures_text(in, walls, kUnit)
    << room_light_text(in, walls, kUnit);
  const auto path = folder / (stem + ".pov");
  write_file(path, t.str());
  report(1);
  return path;
}

}  // namespace witherfield::pov
