// The description of a grass scene's keys: which tables and keys there are, what they mean, which values they
// take.
#pragma once
#include "sim/scene/key_visitor.hpp"
#include "sim/scene/scene.hpp"

namespace witherfield::scene {

/// [terrain]: the terrain itself and the texels on it.
struct TerrainTable {
  terrain::TerrainOptions terrain;
  terrain::PlacementOptions placement;
};

/// A scene as it stands in the file, table by table. (GrassScene is what the simulators take.)
struct SceneTables {
  std::string kind = "grass", name;
  std::uint64_t seed = 1;
  grass::GrassOptions
      grass;  ///< texel, season, tissue, colour, points, variants, frames; samples only through mingle
  grass::BladeOptions blades;
  std::vector<grass::SampleOptions> mingle;
  std::optional<TerrainTable> terrain;
  Still view;
  std::vector<Still> stills;
  OutputOptions output;
};

void describe_scene(KeyVisitor& v, SceneTables& s);

// Parts of it.
void describe_season(KeyVisitor& v, grass::GrassOptions& o);
void describe_texel(KeyVisitor& v, grass::GrassOptions& o);
void describe_model(KeyVisitor& v, SceneTables& s);
void describe_blades(KeyVisitor& v, grass::BladeOptions& b);
void describe_sample(KeyVisitor& v, grass::SampleOptions& s);
void describe_terrain(KeyVisitor& v, TerrainTable& t, const grass::TexelOptions& texel);
void describe_view(KeyVisitor& v, Still& still, bool terrain);
void describe_still(KeyVisitor& v, std::vector<Still>& stills, std::size_t index, const SceneTables& s);
void describe_output(KeyVisitor& v, OutputOptions& o);

SceneTables to_tables(const GrassScene& scene);
GrassScene to_scene(const SceneTables& tables);

/// Shrinks a scene so that it runs in seconds (scene.hpp, load_grass_scene).
void shrink_to_preview(GrassScene& scene);

}  // namespace witherfield::scene
