#include "pov/render.hpp"

#include <unistd.h>

#include <chrono>
#include <vector>

#include "pov/hdr.hpp"
#include "pov/png.hpp"
#include "pov/run_povray.hpp"
#include "pov/scene_parts.hpp"
#include "pov/tonemap.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

/// Removes povray's own output however the render ends.
struct RemoveAtExit {
  std::vector<std::filesystem::path> files;
  ~RemoveAtExit() {
    std::error_code ignored;
    for (const auto& f : files) std::filesystem::remove(f, ignored);
  }
};

/// Media are smooth by themselves; thin blades need many samples; depth of field brings its own.
std::vector<std::string> antialiasing(const SceneHead& head, Quality quality, bool even) {
  if (head.depth_of_field) return {"-A"};
  if (head.look == "texel") {
    if (quality == Quality::final || (quality == Quality::good && !head.field))
      return {"+AM2", "+A0.1", "+R2", "-J"};
    return {"-A"};
  }
  // Awns and margins are thinner than a pixel and all else is cheap: every pixel gets all its samples.
  if (head.look == "object" || even)
    return {"+AM1", "+A0.0", quality == Quality::draft ? "+R2" : quality == Quality::good ? "+R3" : "+R5", "-J"};
  switch (quality) {
    case Quality::draft:
      return {"+AM1", "+A0.3", "+R2", "-J"};
    case Quality::good:
      return {"+AM2", "+A0.1", "+R3", "-J"};
    case Quality::final:
      break;
  }
  return {"+AM2", "+A0.05", "+R4", "-J"};
}

}  // namespace

Radiance render_radiance(const std::filesystem::path& scene, const RenderOptions& options, const Progress& progress) {
  const std::string text = read_file(scene);
  const SceneHead head = parse_head(text, scene.string());
  const int width = options.width_px > 0 ? options.width_px : head.width_px;
  const int height = options.height_px > 0 ? options.height_px : head.height_px;
  const std::filesystem::path folder = std::filesystem::absolute(scene).parent_path();
  const std::string raw = scene.stem().string() + "." + std::to_string(getpid()) + ".part.hdr";
  const RemoveAtExit cleanup{{folder / raw, folder / (scene.stem().string() + ".pov-state")}};
  std::vector<std::string> arguments{"+I" + scene.filename().string(),
                                     "+O" + raw,
                                     "+FH",
                                     "-D",
                                     "-P",
                                     "+W" + std::to_string(width),
                                     "+H" + std::to_string(height),
                                     "Declare=QUALITY=" + std::to_string(int(options.quality))};
  if (options.threads > 0) arguments.push_back("+WT" + std::to_string(options.threads));
  for (const std::string& a : antialiasing(head, options.quality, options.even_samples)) arguments.push_back(a);
  run_povray(folder, arguments, progress);
  Radiance out{decode_hdr(read_file(folder / raw), scene.stem().string() + ": what povray rendered"), head.exposure,
               head.look};
  if (head.look == "texel") mend_specks(out.image);
  return out;
}

RenderResult render_scene(const std::filesystem::path& scene, const std::filesystem::path& png,
                          const RenderOptions& options, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const Radiance picture = render_radiance(scene, options, progress);
  std::error_code error;
  if (png.has_parent_path()) std::filesystem::create_directories(png.parent_path(), error);
  write_png(png, picture.image.width, picture.image.height,
            develop(picture.image, picture.exposure, picture.look == "texel" ? 0.8 : 0.0),
            {{"Software", "witherfield"},
             {"Title", scene.stem().string()},
             {"Comment", "rendered with POV-Ray; " + picture.look + " look"}});
  return {png, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

}  // namespace witherfield::pov
