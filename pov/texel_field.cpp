// Texels over a terrain: far ones share their densities in eight orientations, near ones are merged cell by
// cell.
#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <memory>

#include "pov/media.hpp"
#include "pov/near_cells.hpp"
#include "pov/texel_scene.hpp"

namespace witherfield::pov {
namespace {

constexpr int kNearPiece = 24, kOverhangingPiece = 45, kFoldedPiece = 66;

/// Texels that share their density.
struct FarGroup {
  int variant, lod;
  bool folded;
  auto operator<=>(const FarGroup&) const = default;
};

class FieldWriter {
 public:
  FieldWriter(const SceneContext& c, const StandPlan& plan)
      : c_(c), plan_(plan), to_sun_(c.input->still.sun.direction()) {}

  void write(const Progress& progress) {
    std::map<FarGroup, std::vector<const Stand*>> far;
    std::vector<const Stand*> near;
    for (const Stand& s : plan_.stands)
      (s.boxing == Boxing::merged ? near : far[{s.at.variant, s.at.lod, s.boxing == Boxing::folded}])
          .push_back(&s);
    const double all = double(far.size() * 4 + near.size());
    double done = 0;
    const auto report = [&](double step) {
      if (progress) progress("lighting texels", done / all);
      done += step;
    };
    for (const auto& [group, members] : far) {
      report(4);
      write_far(group, members);
    }
    for (const Stand* s : near) {
      report(1);
      write_near(*s);
    }
  }

  const std::string& declarations() const { return declarations_.str(); }
  const std::string& boxes() const { return boxes_.str(); }
  const GroundLight& ground() const { return ground_; }

 private:
  const TexelPrelight& light(int variant, int lod) {
    auto& p = lights_[{variant, lod}];
    if (!p)
      p = std::make_unique<TexelPrelight>(grid_of(*c_.input, variant, lod), true,
                                          mean_blade_width_m(*c_.input, variant));
    return *p;
  }

  TexelPrelight::Shading shade(const TexelInstance& t, int lod, const glm::dvec3& to_eye) {
    const Illumination sun{to_local_direction(t, to_sun_), c_.day->sun_rgb, c_.day->sky_rgb};
    return light(t.variant, lod).shade(sun, to_local_direction(t, to_eye) * 1e4);
  }

  void note_ground(const TexelPrelight& p, const TexelPrelight::Shading& s, double weight) {
    const Illumination sun{to_sun_, c_.day->sun_rgb, c_.day->sky_rgb};
    const GroundShares g = p.ground(to_sun_);
    ground_.add({g.sun, g.sky, scattered_light(sun, p.mean_albedo(), g.sky), s.mean_sun + s.mean_rest,
                 p.mean_diffuse()},
                weight);
  }

  void write_far(const FarGroup& group, const std::vector<const Stand*>& members) {
    const TexelGrid& grid = grid_of(*c_.input, group.variant, group.lod);
    const TexelPrelight& p = light(group.variant, group.lod);
    const MediaBlock block = media_block(grid, group.folded);
    const std::string name =
        (Text() << (group.folded ? "F" : "H") << group.variant << "L" << group.lod).str();
    std::array<std::vector<const Stand*>, 8> by_orientation;
    for (const Stand* s : members) by_orientation[std::size_t(s->orientation())].push_back(s);
    MediaNames names;
    std::vector<MediaPiece> pieces;
    for (std::size_t o = 0; o < 8; ++o) {
      if (by_orientation[o].empty()) continue;
      // One shading serves all texels that stand alike: for the mean direction to the eye.
      glm::dvec3 to_eye(0.0);
      for (const Stand* s : by_orientation[o]) to_eye += direction_to_eye(s->at) / s->distance_m;
      const TexelPrelight::Shading shading =
          shade(by_orientation[o].front()->at, group.lod, glm::normalize(to_eye));
      MediaSamples samples(block);
      add_texel(samples, block, grid, p, shading.radiance, group.folded);
      if (pieces.empty()) {
        pieces = find_pieces(block, samples.density, group.folded ? kFoldedPiece : kOverhangingPiece);
        names = declare_density(declarations_, c_, block, samples, name);
        note_ground(p, shading, double(members.size()));
      }
      declare_emission(declarations_, c_, block, samples, (Text() << name << "o" << o).str(), names);
      for (const Stand* s : by_orientation[o])
        boxes_ << boxes_text(c_, block, pieces, box_overlap(s->at.cell_i, s->at.cell_j), names,
                             p.per_density(), slope_factor(smoothed(plan_, s->at), to_sun_, shading),
                             instance_matrix(s->at, c_.input->tile_m, c_.unit), s->at.height_scale);
    }
  }

  glm::dvec3 direction_to_eye(const TexelInstance& t) const {
    const double half = c_.input->tile_m / 2;
    return glm::normalize(c_.input->still.camera.position_m -
                          (t.origin_m + glm::dvec3(half, half, half / 2)));
  }

  /// Shading of one instance as its neighbours' cells at this LOD see it, kept until all near cells are
  /// written.
  const TexelPrelight::Shading& shading_of(const TexelInstance& t, int lod) {
    auto& s = shadings_[{t.cell_i, t.cell_j, lod}];
    if (!s) s = std::make_unique<TexelPrelight::Shading>(shade(t, lod, direction_to_eye(t)));
    return *s;
  }

  void write_near(const Stand& stand) {
    std::vector<CellPart> parts;
    std::vector<glm::dvec3> factors;
    const int lod = stand.at.lod;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const auto found = plan_.cells.find({stand.at.cell_i + i, stand.at.cell_j + j});
        if (found == plan_.cells.end()) continue;
        const TexelInstance& t = found->second;
        const TexelPrelight::Shading& s = shading_of(t, lod);
        parts.push_back({&t, &grid_of(*c_.input, t.variant, lod), &light(t.variant, lod), &s.radiance});
        factors.push_back(slope_factor(smoothed(plan_, t), to_sun_, s));
      }
    NearCell cell = merge_cell(stand.at, c_.input->tile_m, parts, factors);
    const std::vector<MediaPiece> pieces = find_pieces(cell.block, cell.samples.density, kNearPiece);
    const std::string name = (Text() << "N" << near_count_++).str();
    const TexelPrelight& own = light(stand.at.variant, lod);
    if (ground_.weight == 0) note_ground(own, shading_of(stand.at, lod), 1);
    MediaNames names = declare_density(declarations_, c_, cell.block, cell.samples, name);
    declare_emission(declarations_, c_, cell.block, cell.samples, name, names);
    TexelInstance upright = stand.at;
    upright.quarter_turns = 0;
    upright.mirrored = false;
    upright.height_scale = 1;
    boxes_ << boxes_text(c_, cell.block, pieces, box_overlap(stand.at.cell_i, stand.at.cell_j), names,
                         own.per_density(), glm::dvec3(1.0),
                         instance_matrix(upright, c_.input->tile_m, c_.unit));
  }

  const SceneContext& c_;
  const StandPlan& plan_;
  glm::dvec3 to_sun_;
  std::map<std::pair<int, int>, std::unique_ptr<TexelPrelight>> lights_;            // variant, LOD
  std::map<std::array<int, 3>, std::unique_ptr<TexelPrelight::Shading>> shadings_;  // cell, LOD
  int near_count_ = 0;
  Text declarations_, boxes_;
  GroundLight ground_;
};

}  // namespace

std::filesystem::path write_texel_field(const SceneContext& c, const Progress& progress) {
  const StandPlan plan = plan_stands(*c.input, c.around, 0);
  FieldWriter w(c, plan);
  w.write(progress);
  const Still& still = c.input->still;
  Text t;
  t << head_text({still.width_px, still.height_px, still.exposure, "texel", false, true}, c.stem)
    << atmosphere_text(c) << quality_text() << terrain_text(c, w.ground(), false) << w.declarations()
    << w.boxes();
  const auto path = c.folder / (c.stem + ".pov");
  write_file(path, t.str());
  return path;
}

}  // namespace witherfield::pov
