#include "cli/leaf_input.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "sim/core/errors.hpp"
#include "vis/mesh_files.hpp"

namespace witherfield::cli {

leaf::LeafInput read_leaf_input(const scene::LeafScene& s) {
  leaf::LeafInput input;
  if (s.leaf.source != leaf::LeafSource::mesh && !s.leaf.points_file.empty()) {
    std::ifstream in(s.leaf.points_file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    if (!in) throw IoFailure("cannot read '" + s.leaf.points_file + "'");
    const bool json = std::filesystem::path(s.leaf.points_file).extension() == ".json";
    input.points = (json ? leaf::parse_outline_json : leaf::parse_outline_csv)(text.str(), s.leaf.points_file, s.points_unit);
  }
  if (s.leaf.source == leaf::LeafSource::mesh) {
    vis::MeshFile file = vis::read_mesh_file(s.leaf.mesh_file);
    if (file.length_unit.empty())
      for (glm::dvec3& p : file.surface.position_m) p *= s.mesh_unit_mm * 1e-3;
    input.mesh = std::move(file.surface);
  }
  return input;
}

Surface whole_leaf(const leaf::LeafModel& model, const std::vector<glm::dvec3>& position_m) {
  Surface s = leaf::to_surface(model, position_m);
  s.make_field("organ_id");
  std::fill(s.make_field("chlorophyll_ug_cm2").values.begin(), s.make_field("chlorophyll_ug_cm2").values.end(),
            float(model.chlorophyll_ug_cm2));
  Surface petiole = leaf::petiole_surface(model.petiole);
  if (petiole.triangles.empty()) return s;
  auto& organ = petiole.make_field("organ_id").values;
  std::fill(organ.begin(), organ.end(), float(kPetioleOrgan));
  append(s, petiole);
  return s;
}

}  // namespace witherfield::cli
