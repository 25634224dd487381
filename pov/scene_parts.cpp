#include "pov/scene_parts.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

std::string rgb(const glm::dvec3& c) {
  return (Text() << "rgb" << c).str();
}

double scene_size_m(const SceneContext& c) {
  return std::max(c.around->high_x_m() - c.around->low_x_m(), c.around->high_y_m() - c.around->low_y_m());
}

}  // namespace

void GroundLight::add(const GroundLight& m, double more_weight) {
  const double a = weight / (weight + more_weight), b = 1 - a;
  sun = a * sun + b * m.sun;
  sky = a * sky + b * m.sky;
  scattered_rgb = a * scattered_rgb + b * m.scattered_rgb;
  canopy_rgb = a * canopy_rgb + b * m.canopy_rgb;
  litter_rgb = a * litter_rgb + b * m.litter_rgb;
  weight += more_weight;
}

std::string head_text(const SceneHead& h, const std::string& title) {
  Text t;
  t << "// witherfield scene: " << title << "\n// width_px " << h.width_px << " height_px " << h.height_px
    << " exposure " << h.exposure << " look " << h.look << " depth_of_field " << int(h.depth_of_field)
    << " field " << int(h.field)
    << "\n// Render as HDR (+FH) in this folder; tone mapping follows. QUALITY: 0 draft, 1 good, 2 final.\n";
  return t.str();
}

SceneHead parse_head(const std::string& text, const std::string& file) {
  SceneHead h;
  const std::size_t at = text.find("\n// width_px ");
  int dof = 0, field = 0;
  std::string key[6], slashes;
  std::istringstream in(at == std::string::npos ? "" : text.substr(at + 1, 200));
  in.imbue(std::locale::classic());
  in >> slashes >> key[0] >> h.width_px >> key[1] >> h.height_px >> key[2] >> h.exposure >> key[3] >>
      h.look >> key[4] >> dof >> key[5] >> field;
  if (!in || !text.starts_with("// witherfield scene") || h.width_px < 1 || h.height_px < 1 ||
      !(h.exposure > 0))
    throw InvalidInput(
        file + " is not a scene written by witherfield (its first lines do not say size and exposure)");
  h.depth_of_field = dof != 0;
  h.field = field != 0;
  return h;
}

glm::dvec3 backdrop_rgb(const SceneContext& c) {
  const double up = c.input->still.sun.direction().z;
  return kBackdrop * (c.day->sun_rgb * up + c.day->sky_rgb) * 0.55;
}

std::string camera_text(const Camera& cam, double unit) {
  Text t;
  t << "camera{location " << flip(cam.position_m, unit) << " right x*image_width/image_height up y angle "
    << cam.fov_deg << " look_at " << flip(cam.look_at_m, unit);
  if (cam.aperture_m > 0) {
    const glm::dvec3 view = cam.look_at_m - cam.position_m;
    const double focus = cam.focus_m > 0 ? cam.focus_m : glm::length(view);
    t << "\n  aperture " << cam.aperture_m * unit << " focal_point "
      << flip(cam.position_m + glm::normalize(view) * focus, unit)
      << " blur_samples (QUALITY=0?12:(QUALITY=1?40:90)) confidence 0.95 variance 1/4000";
  }
  t << "}\n";
  return t.str();
}

std::string atmosphere_text(const SceneContext& c) {
  Text t;
  t << "#version 3.7;\n#ifndef(QUALITY) #declare QUALITY=1; #end\n#default{finish{ambient 0 diffuse 1}}\n"
    << "global_settings{assumed_gamma 1.0 max_trace_level 10}\n"
    << camera_text(c.input->still.camera, c.unit) << "light_source{" << flip(c.input->still.sun.direction(), 1e5 * c.unit) << " "
    << rgb(c.day->sun_rgb) << " parallel point_at 0 media_interaction off}\n";
  if (!c.around) {  // a pale wall, into which the studio's floor runs
    const glm::dvec3 wall = backdrop_rgb(c);
    t << "sky_sphere{pigment{gradient y color_map{[0 " << rgb(wall) << "][0.6 " << rgb(wall * 0.5)
      << "]}}}\n";
    return t.str();
  }
  const std::string sky = c.stem + "_sky.hdr";
  write_file(c.folder / sky, encode_hdr(c.day->map));
  const double size = scene_size_m(c) * c.unit, plain = c.around->plain_m() * c.unit;
  t << "sky_sphere{pigment{image_map{hdr \"" << sky << "\" map_type 1 interpolate 2}}}\n"
    << "fog{fog_type 2 distance " << 9 * size << " color " << rgb(c.day->horizon_rgb) << " fog_offset "
    << plain + 0.05 * size << " fog_alt " << 0.12 * size << "}\n";
  return t.str();
}

namespace {

void append_terrain(Text& t, const SceneContext& c) {
  const TriMesh& m = *c.input->ground;
  t << "mesh2{vertex_vectors{" << m.n_vertices();
  for (const auto v : m.vertices()) {
    const auto p = m.point(v);
    t << "," << flip({p[0], p[1], p[2]}, c.unit);
  }
  t << "}\nnormal_vectors{" << m.n_vertices();
  for (const auto v : m.vertices()) {
    const auto n = m.normal(v);
    t << "," << flip({n[0], n[1], n[2]});
  }
  t << "}\nface_indices{" << m.n_faces();
  for (const auto f : m.faces()) {
    t << ",<";
    const char* comma = "";
    for (const auto v : m.fv_range(f)) {
      t << comma << v.idx();
      comma = ",";
    }
    t << ">";
  }
  t << "}}\n";
}

/// The ring around the placement as one grid of quads, a vertex per cell corner; cells inside are left to the
/// terrain.
void append_ring(Text& t, const SceneContext& c) {
  const Placement& p = *c.input->placement;
  const Surroundings& s = *c.around;
  const int extra = std::max(s.cells(), int(std::ceil(s.reach_m() / p.tile_m)) + 1);
  const int nx = p.cells_x + 2 * extra, ny = p.cells_y + 2 * extra;
  t << "mesh2{vertex_vectors{" << (nx + 1) * (ny + 1);
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) {
      const double x = s.low_x_m() + (i - extra) * p.tile_m, y = s.low_y_m() + (j - extra) * p.tile_m;
      t << "," << flip({x, y, s.height_m(x, y)}, c.unit);
    }
  const auto inside = [&](int i, int j) {
    return i >= extra && j >= extra && i < extra + p.cells_x && j < extra + p.cells_y;
  };
  t << "}\nface_indices{" << 2 * (nx * ny - p.cells_x * p.cells_y);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      if (inside(i, j)) continue;
      const int a = j * (nx + 1) + i, b = a + 1, d = a + nx + 1, e = d + 1;
      t << ",<" << a << "," << b << "," << e << ">,<" << a << "," << e << "," << d << ">";
    }
  t << "}}\n";
}

}  // namespace

std::string terrain_text(const SceneContext& c, const GroundLight& light, bool shadows) {
  const double tile = kUnitsPerTile, share = shadows ? 1.0 : light.sun;
  // Thatch and litter of the grass itself cover most of the soil in a sward; the soil is black loam (ECOSTRESS library:
  // sRGB 80, 61, 38).
  const glm::dvec3 soil{0.0802, 0.0467, 0.0194};
  const glm::dvec3 floor = 0.2 * soil + 0.8 * light.litter_rgb;
  const glm::dvec3 around = c.day->sky_rgb * light.sky + light.scattered_rgb;
  Text t;
  t << "#declare Floor=texture{pigment{bozo scale " << 0.12 * tile << " color_map{[0 " << rgb(floor * 0.8)
    << "][1 " << rgb(floor * 1.2) << "]}} finish{diffuse " << share << " emission " << rgb(around) << "}}\n"
    << "#declare Meadow=texture{pigment{bozo scale " << 1.7 * tile << " turbulence 0.6 color_map{[0 "
    << rgb(light.canopy_rgb * 0.78) << "][1 " << rgb(light.canopy_rgb * 1.12)
    << "]}} finish{diffuse 0 emission 1}}\n";
  t << "union{\n";
  if (c.input->ground) append_terrain(t, c);
  append_ring(t, c);
  t << "texture{Floor}}\n";
  const Surroundings& s = *c.around;
  const double lift = s.plain_m() - 0.01 * c.input->tile_m;
  const glm::dvec3 lo = flip({s.low_x_m(), s.low_y_m(), 0}, c.unit),
                   hi = flip({s.high_x_m(), s.high_y_m(), 0}, c.unit);
  t << "plane{y," << lift * c.unit << " clipped_by{box{<" << lo.x << ",-1e6," << lo.z << ">,<" << hi.x
    << ",1e6," << hi.z << "> inverse}} texture{Meadow}}\n";
  return t.str();
}

}  // namespace witherfield::pov
