#include "pov/object_scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "pov/leaf_skin.hpp"
#include "pov/object_text.hpp"
#include "pov/png.hpp"
#include "pov/scene_parts.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

constexpr double kUnit = 1000;            // POV-Ray units per metre: millimetres, far above its tolerance of 0.001
constexpr double kEdgePixels = 4.5;         // seen faces are made finer than this on the picture
constexpr std::size_t kMostFaces = 1500000;

void check(double value, double low, double high, const std::string& what) {
  if (!(value >= low && value <= high))
    throw InvalidInput("object scene: " + what + " must be " + std::to_string(low) + " to " + std::to_string(high) +
                       ", got " + std::to_string(value));
}

void check_object(const ObjectPlacement& o, const std::string& name) {
  if (!o.surface) throw InvalidInput("object scene: " + name + " has no surface");
  if (o.surface->triangles.empty()) throw InvalidInput("object scene: " + name + " has no faces");
  if (!(o.scale > 0))
    throw InvalidInput("object scene: " + name + ": scale must be > 0, got " + std::to_string(o.scale));
  try {
    o.surface->validate();
    if (o.surface->field("diffuse").on_faces)
      throw InvalidInput("field 'diffuse' must lie on vertices, lies on faces");
  } catch (const InvalidInput& e) {
    throw InvalidInput("object scene: " + name + ": " + e.what());
  }
  const auto look = [&](const ObjectLook& l) {
    check(l.gloss, 0, 4, name + ": gloss");
    check(l.relief, 0, 4, name + ": relief");
    check(l.softness, 0, 4, name + ": softness");
  };
  look(o.other_look);
  if (!o.surface->uv.empty()) return;
  const SurfaceField* organ = o.surface->has_field("organ_id") ? &o.surface->field("organ_id") : nullptr;
  for (std::size_t f = 0; f < o.surface->triangles.size(); ++f) {
    const std::size_t item = organ && organ->on_faces ? f : std::size_t(o.surface->triangles[f][0]);
    const ObjectLook& l = look_of(o, organ ? int(std::lround(organ->values[item])) : 0);
    if (l.kind == LookKind::leaf && l.detail)
      throw InvalidInput("object scene: " + name + ": detail of a leaf needs texture coordinates, the surface has none");
  }
}

void check_input(const ObjectSceneInput& in) {
  if (in.objects.empty())
    throw InvalidInput("object scene '" + in.still.name + "': there must be at least one object, got 0");
  check(in.key_size, 0.05, 4, "key_size");
  check(in.fill, 0, 4, "fill");
  check(in.rim, 0, 4, "rim");
  check(in.ground_gap_m, 0, 100, "ground_gap_m");
  check(in.still.width_px, 1, 16384, "width_px");
  check(in.still.height_px, 1, 16384, "height_px");
  if (!(glm::length(in.still.camera.look_at_m - in.still.camera.position_m) > 0))
    throw InvalidInput("object scene: the camera looks at itself (position equals look_at)");
  for (std::size_t i = 0; i < in.objects.size(); ++i) check_object(in.objects[i], "object " + std::to_string(i));
}

/// Writes a picture of glow and declares it as pigment `name`.
std::string picture(const std::filesystem::path& folder, const std::string& file, const std::string& name, int width,
                    int height, std::vector<glm::vec3> glow, const std::string& more) {
  for (glm::vec3& g : glow) g /= float(kFullGlow);
  write_png_linear(folder / file, width, height, glow);
  return "#declare " + name + "=pigment{uv_mapping image_map{png \"" + file + "\" gamma 1.0 interpolate 2} " + more +
         "}\n";
}

/// Meshes (one an organ) and pictures of one object, and the words that show it.
class ObjectText {
 public:
  ObjectText(const std::filesystem::path& folder, const std::string& stem, std::size_t number, const Studio& studio,
             const View& view)
      : folder_(folder), stem_(stem + "_" + std::to_string(number)), id_(std::to_string(number)), studio_(studio),
        view_(view) {}

  std::string write(const ObjectPlacement& o, const LitMesh& m, const Glow& glow) const {
    std::map<int, std::vector<int>> organs;
    for (std::size_t f = 0; f < m.organ.size(); ++f) organs[m.organ[f]].push_back(int(f));
    Text t;
    std::optional<FaceAtlas> atlas;  // shared by all organs without a skin of their own
    for (const auto& [organ, faces] : organs) {
      const ObjectLook& look = look_of(o, organ);
      const std::string file = stem_ + "_" + std::to_string(organ) + ".inc";
      if (look.kind == LookKind::leaf && look.detail && !o.facets) {
        t << skin(o, m, faces, glow, organ, file);
        continue;
      }
      const std::string front = "Front" + id_, back = m.thin ? "Back" + id_ : front;
      if (!atlas) {
        atlas.emplace(m.triangles, glow.front);
        t << picture(folder_, stem_ + "_front.png", front, atlas->width(), atlas->height(), atlas->paint(glow.front),
                     atlas->scale());
        if (m.thin)
          t << picture(folder_, stem_ + "_back.png", back, atlas->width(), atlas->height(), atlas->paint(glow.back),
                       atlas->scale());
      }
      write_file(folder_ / file, mesh2_text(m, faces, *atlas, kUnit));
      t << "object{#include \"" << file << "\"\n" << look_text(look, front, back) << "}\n";
    }
    return t.str();
  }

 private:
  std::string skin(const ObjectPlacement& o, const LitMesh& m, std::span<const int> faces, const Glow& glow, int organ,
                   const std::string& file) const {
    SkinPictures painted = paint_skin(studio_, view_, m, faces, glow, look_of(o, organ), o.scale);
    const std::string tail = id_ + "_" + std::to_string(organ), front = "SkinFront" + tail, back = "SkinBack" + tail,
                      name = stem_ + "_" + std::to_string(organ);
    Text t;
    t << picture(folder_, name + "_front.png", front, painted.pixels, painted.pixels, std::move(painted.front), "")
      << picture(folder_, name + "_back.png", back, painted.pixels, painted.pixels, std::move(painted.back), "");
    write_file(folder_ / file, mesh2_text(m, faces, kUnit));
    t << "object{#include \"" << file << "\"\n" << skin_text(front, back) << "}\n";
    return t.str();
  }

  std::filesystem::path folder_;
  std::string stem_, id_;
  const Studio& studio_;
  const View& view_;
};

std::string paper_text(const std::filesystem::path& folder, const std::string& stem, const Studio& s,
                       const std::vector<glm::vec3>& glow) {
  if (s.paper.empty()) return "";
  const int n = s.paper.nodes();
  std::vector<glm::vec3> rows;  // pictures start at the top
  for (int j = n - 1; j >= 0; --j) rows.insert(rows.end(), glow.begin() + j * n, glow.begin() + (j + 1) * n);
  const std::string file = stem + "_paper.inc";
  write_file(folder / file, s.paper.mesh_text(kUnit));
  return picture(folder, stem + "_paper.png", "Paper", n, n, std::move(rows), "") + "object{#include \"" + file +
         "\"\ntexture{pigment{Paper} " + (Text() << "finish{diffuse 0 emission " << kFullGlow << "}}}\n").str();
}

}  // namespace

std::filesystem::path write_object_scene(const std::filesystem::path& folder, const ObjectSceneInput& in,
                                         const Progress& progress) {
  check_input(in);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw IoFailure("cannot make folder " + folder.string() + ": " + error.message());
  const auto report = [&](double done) {
    if (progress) progress("lighting objects", done);
  };
  const Studio studio = make_studio(in);
  const View view(in.still);
  report(0);
  std::vector<LitMesh> meshes;
  for (const ObjectPlacement& o : in.objects) meshes.push_back(place_mesh(o));
  const SceneTree tree(meshes);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    mark_seen(meshes[i], tree, view);
    const double pixel = view.pixel_m(glm::vec3(studio.center_m));
    refine_mesh(meshes[i], in.objects[i], kEdgePixels * pixel, kMostFaces / meshes.size());
  }
  report(0.1);
  const StudioGlow glow = light_studio(studio, view, tree, meshes);
  report(0.8);
  const std::string stem = in.still.name + "_object";
  const SceneHead head{in.still.width_px, in.still.height_px, in.still.exposure, "object",
                       in.still.camera.aperture_m > 0, false};
  Text t;
  t << head_text(head, stem) << "#version 3.7;\n#ifndef(QUALITY) #declare QUALITY=1; #end\n"
    << "#default{finish{ambient 0 diffuse 0}}\n"
    << camera_text(in.still.camera, kUnit) << studio_text(studio, kUnit) << paper_text(folder, stem, studio, glow.paper);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    t << ObjectText(folder, stem, i, studio, view).write(in.objects[i], meshes[i], glow.meshes[i]);
    report(0.8 + 0.2 * double(i + 1) / double(meshes.size()));
  }
  const auto path = folder / (stem + ".pov");
  write_file(path, t.str());
  return path;
}

}  // namespace witherfield::pov
