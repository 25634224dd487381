#include "pov/scene_writer.hpp"

#include <memory>

#include "pov/blade_scene.hpp"
#include "pov/texel_scene.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {

std::vector<std::filesystem::path> write_scenes(const std::filesystem::path& folder, const SceneInput& input,
                                                const Progress& progress) {
  if (input.variants.empty()) throw InvalidInput("write_scenes: there must be at least one variant, got 0");
  if (!(input.tile_m > 0))
    throw InvalidInput("write_scenes: the tile must be > 0 m wide, got " + std::to_string(input.tile_m));
  if (input.placement && input.placement->instances.empty())
    throw InvalidInput("write_scenes: the placement has no texels");
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw IoFailure("cannot make folder " + folder.string() + ": " + error.message());

  const Daylight day = make_daylight(input.still.sun);
  std::unique_ptr<Surroundings> around;
  if (input.placement) around = std::make_unique<Surroundings>(*input.placement);
  std::vector<std::filesystem::path> written;
  for (const std::string& look : input.still.looks) {
    SceneContext c{&input, folder,      input.still.name + "_" + look, kUnitsPerTile / input.tile_m,
                   &day,   around.get()};
    if (look == "texel")
      written.push_back(around ? write_texel_field(c, progress) : write_texel_alone(c, progress));
    else if (look == "blades")
      written.push_back(around ? write_blade_field(c, progress) : write_blades_alone(c, progress));
    else
      throw InvalidInput("still '" + input.still.name + "': unknown look '" + look +
                         "', must be texel or blades");
  }
  return written;
}

}  // namespace witherfield::pov
