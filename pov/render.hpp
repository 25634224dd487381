// Runs povray on a scene of write_scenes, as HDR, and tone-maps the result to PNG.
#pragma once
#include <filesystem>
#include <string>

#include "pov/hdr.hpp"
#include "sim/core/progress.hpp"

namespace witherfield::pov {

enum class Quality { draft, good, final };

struct RenderOptions {
  int width_px = 0, height_px = 0;  ///< 0 = as the scene says
  Quality quality = Quality::good;
  int threads = 0;  ///< 0 = all
  /// Every pixel gets all its samples, at the same places: pictures of a film must not differ by where the renderer
  /// chose to look closer. Not for media and depth of field.
  bool even_samples = false;
};

struct RenderResult {
  std::filesystem::path png;
  double seconds = 0;
};

/// Renders one scene file to images/<stem>.png beside the pov folder. Progress comes from povray's own rows.
/// @throws IoFailure when povray is missing (names the Debian package), fails (its last messages) or the
/// picture cannot be written; nothing half-written stays.
RenderResult render_scene(const std::filesystem::path& scene, const std::filesystem::path& png,
                          const RenderOptions& options, const Progress& progress = {});

/// The same picture as scene radiance, before tone mapping, and the exposure that its scene asks for.
struct Radiance {
  HdrImage image;
  double exposure = 1;
  std::string look;
};
/// @throws IoFailure as above.
Radiance render_radiance(const std::filesystem::path& scene, const RenderOptions& options, const Progress& progress = {});

}  // namespace witherfield::pov
