#include "pov/object_scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "pov/object_look.hpp"
#include "pov/png.hpp"
#include "pov/scene_parts.hpp"
#include "pov/studio_light.hpp"
#include "pov/surface_mesh.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

constexpr double kUnit = 1000;  // POV-Ray units per metre: millimetres, far above its tolerance of 0.001

void check(double value, double low, double high, const std::string& what) {
  if (!(value >= low && value <= high))
    throw InvalidInput("object scene: " + what + " must be " + std::to_string(low) + " to " + std::to_string(high) +
                       ", got " + std::to_string(value));
}

const ObjectLook& look_of(const ObjectPlacement& o, int organ) {
  const auto found = o.looks.find(organ);
  return found == o.looks.end() ? o.other_look : found->second;
}

void check_input(const ObjectSceneInput& in) {
  if (in.objects.empty()) throw InvalidInput("object scene '" + in.still.name + "': there must be at least one object, got 0");
  check(in.key_size, 0.05, 4, "key_size");
  check(in.fill, 0, 4, "fill");
  check(in.rim, 0, 4, "rim");
  check(in.ground_gap_m, 0, 100, "ground_gap_m");
  check(in.still.width_px, 1, 16384, "width_px");
  check(in.still.height_px, 1, 16384, "height_px");
  if (glm::length(in.still.camera.look_at_m - in.still.camera.position_m) <= 0)
    throw InvalidInput("object scene: the camera looks at itself (position equals look_at)");
  for (std::size_t i = 0; i < in.objects.size(); ++i) {
    const ObjectPlacement& o = in.objects[i];
    const std::string name = "object " + std::to_string(i);
    if (!o.surface) throw InvalidInput("object scene: " + name + " has no surface");
    if (o.surface->triangles.empty()) throw InvalidInput("object scene: " + name + " has no faces");
    if (!(o.scale > 0)) throw InvalidInput("object scene: " + name + ": scale must be > 0, got " + std::to_string(o.scale));
    try {
      o.surface->validate();
      o.surface->field("diffuse");
    } catch (const InvalidInput& e) {
      throw InvalidInput("object scene: " + name + ": " + e.what());
    }
    const auto look = [&](const ObjectLook& l) {
      check(l.gloss, 0, 4, name + ": gloss");
      check(l.relief, 0, 4, name + ": relief");
      check(l.softness, 0, 4, name + ": softness");
    };
    look(o.other_look);
    for (const auto& [organ, l] : o.looks) look(l);
  }
}

/// "matrix<...>": rows are where POV-Ray's axes go.
std::string matrix(const ObjectPlacement& o) {
  const auto axis = [&](const glm::dvec3& a) { return flip(o.world(a) - o.position_m); };
  const glm::dvec3 x = axis({1, 0, 0}), y = axis({0, 0, 1}), z = axis({0, 1, 0}), p = flip(o.position_m, kUnit);
  Text t;
  t << "matrix<";
  for (const glm::dvec3& row : {x, y, z}) t << row.x << "," << row.y << "," << row.z << ",";
  t << p.x << "," << p.y << "," << p.z << ">";
  return t.str();
}

/// Writes the meshes and pictures of each surface once, however often it is placed.
class ObjectWriter {
 public:
  ObjectWriter(const std::filesystem::path& folder, std::string stem) : folder_(folder), stem_(std::move(stem)) {}

  std::string place(const ObjectPlacement& o) {
    const Written& w = written(o);
    Text t;
    t << "union{\n";
    for (const auto& [organ, mesh] : w.meshes)
      t << "object{" << mesh << "\n" << look_text(look_of(o, organ), w.pigments) << "}\n";
    t << matrix(o) << "}\n";
    return t.str();
  }
  std::string declarations() const { return declarations_.str(); }

 private:
  struct Written {
    std::map<int, std::string> meshes;  ///< by organ
    Pigments pigments;
  };

  std::string picture(const std::string& name, const FaceAtlas& atlas, std::span<const glm::vec3> colour,
                      const char* more) {
    const std::string file = stem_ + "_" + name + ".png";
    write_png_linear(folder_ / file, atlas.width(), atlas.height(), atlas.paint(colour));
    declarations_ << "#declare P" << name << "=pigment{uv_mapping image_map{png \"" << file
                  << "\" gamma 1.0 interpolate 2" << more << "} " << atlas.scale() << "}\n";
    return "P" + name;
  }

  const Written& written(const ObjectPlacement& o) {
    const auto [entry, fresh] = done_.try_emplace(o.surface);
    Written& w = entry->second;
    const Surface& s = *o.surface;
    bool thin = false;
    const auto organs = faces_by_organ(s);
    for (const auto& [organ, faces] : organs) thin = thin || look_of(o, organ).kind == LookKind::leaf;
    if (!fresh && (!thin || !w.pigments.through.empty())) return w;
    const std::string name = std::to_string(number_++);
    const VertexColours colours = vertex_colours(s, thin);
    const FaceAtlas atlas(s, colours.front);
    w.pigments.front = picture(name + "_front", atlas, colours.front, "");
    if (thin) {
      w.pigments.back = picture(name + "_back", atlas, colours.back, "");
      w.pigments.through = picture(name + "_through", atlas, colours.through, " transmit all 0.5");
    }
    const auto normals = s.normal.empty() ? vertex_normals(s) : s.normal;
    for (const auto& [organ, faces] : organs) {
      const std::string mesh = "O" + name + "_" + std::to_string(organ), file = stem_ + "_" + mesh + ".inc";
      write_file(folder_ / file, mesh2_text(s, normals, faces, atlas, kUnit));
      declarations_ << "#declare " << mesh << "=#include \"" << file << "\"\n";
      w.meshes[organ] = mesh;
    }
    return w;
  }

  std::filesystem::path folder_;
  std::string stem_;
  int number_ = 0;
  std::map<const Surface*, Written> done_;
  Text declarations_;
};

}  // namespace

std::filesystem::path write_object_scene(const std::filesystem::path& folder, const ObjectSceneInput& in,
                                         const Progress& progress) {
  check_input(in);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw IoFailure("cannot make folder " + folder.string() + ": " + error.message());
  const std::string stem = in.still.name + "_object";
  ObjectWriter writer(folder, stem);
  Text placed;
  for (std::size_t i = 0; i < in.objects.size(); ++i) {
    if (progress) progress("writing objects", double(i) / double(in.objects.size()));
    placed << writer.place(in.objects[i]);
  }
  const SceneHead head{in.still.width_px, in.still.height_px, in.still.exposure, "object",
                       in.still.camera.aperture_m > 0, false};
  Text t;
  t << head_text(head, stem) << "#version 3.7;\n#ifndef(QUALITY) #declare QUALITY=1; #end\n#ifndef(SSS) #declare SSS=0; #end\n"
    << "#default{finish{ambient 0 diffuse 1}}\n"
    << camera_text(in.still.camera, kUnit) << studio_light_text(in, make_studio(in, kUnit)) << writer.declarations()
    << placed.str();
  const auto path = folder / (stem + ".pov");
  write_file(path, t.str());
  return path;
}

}  // namespace witherfield::pov
