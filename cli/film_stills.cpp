// The film of what moves as it withers: the stills that differ in their time alone, in the order of their weathering
// degree. Leaves and blades droop by many of their widths from one still to the next, so a cross-fade would show two of each: no
// picture is invented, each stands for its share of the time.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/console.hpp"
#include "cli/film.hpp"
#include "cli/run_scene.hpp"
#include "pov/tonemap.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kSecondsPerPicture = 0.5;

std::string scene_file(const StillRecord& s, const std::string& look) {
  for (const auto& [name, file] : s.scenes)
    if (look.empty() || name == look) return file;
  return "";
}

/// What the scene says of each still but for its name and its time: stills that agree in it make one film.
class Views {
 public:
  explicit Views(const fs::path& folder) {
    for (Json still : Json::parse(read_scene_json(folder)).value("still", Json::array())) {
      const std::string name = still.value("name", "");
      still.erase("name");
      still.erase("wd");
      views_[name] = std::move(still);
    }
  }
  bool agree(const std::string& a, const std::string& b) const {
    const auto first = views_.find(a), second = views_.find(b);
    return first != views_.end() && second != views_.end() && first->second == second->second;
  }

 private:
  std::map<std::string, Json> views_;
};

/// The stills of the film, by weathering degree.
std::vector<StillRecord> choose(const FilmRequest& request, const RunSummary& run) {
  std::string names;
  const StillRecord* lead = nullptr;
  for (const StillRecord& s : run.stills) {
    names += (names.empty() ? "" : ", ") + s.still.name;
    if (request.scene.empty() ? !scene_file(s, request.look).empty() : s.still.name == request.scene) lead = &s;
  }
  if (!lead)
    throw InvalidInput(request.scene.empty()
                           ? fmt::format("'{}' has no still{}", request.folder.string(),
                                         request.look.empty() ? "" : " with the look " + request.look)
                           : fmt::format("--scene {}: no still of this name in '{}'; there are: {}", request.scene,
                                         request.folder.string(), names));
  const Views views(request.folder);
  std::vector<StillRecord> film;
  for (const StillRecord& s : run.stills)
    if (views.agree(s.still.name, lead->still.name) && !scene_file(s, request.look).empty()) film.push_back(s);
  std::stable_sort(film.begin(), film.end(), [](const auto& a, const auto& b) { return a.still.wd < b.still.wd; });
  if (film.size() < 2)
    throw InvalidInput(fmt::format("still {} is the only one of '{}' with its view{}; a film of kind {} shows "
                                   "stills that differ in `wd` alone: add some to the scene file",
                                   lead->still.name, request.folder.string(),
                                   request.look.empty() ? "" : " and the look " + request.look, run.kind));
  return film;
}

}  // namespace

void film_stills(const FilmRequest& request, const RunSummary& run, Console& console) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<StillRecord> stills = choose(request, run);
  const std::string look = request.look.empty() ? stills.front().scenes.front().first : request.look;
  const Still& first = stills.front().still;
  pov::RenderOptions render = request.render;
  render.width_px = request.width_px > 0 ? request.width_px : first.width_px;
  render.height_px = request.height_px > 0 ? request.height_px : first.height_px;
  render.width_px += render.width_px % 2;
  render.height_px += render.height_px % 2;

  std::vector<std::vector<std::uint8_t>> pictures;
  Json shown = Json::array();
  const Progress bar = console.progress();
  for (const StillRecord& s : stills) {
    check_interrupted();
    pov::Radiance picture;
    try {
      picture = pov::render_radiance(request.folder / scene_file(s, look), render, [&](std::string_view, double fraction) {
        bar("pictures of " + look, (double(pictures.size()) + fraction) / double(stills.size()));
      });
    } catch (...) {
      check_interrupted();
      throw;
    }
    pictures.push_back(pov::develop(picture.image, picture.exposure, picture.look == "texel" ? 0.8 : 0.0));
    shown.push_back({{"still", s.still.name}, {"wd", s.still.wd}});
  }
  const double seconds = request.seconds > 0 ? request.seconds : kSecondsPerPicture * double(stills.size());
  FrameSource source{stills.back().still.name + "_" + look, render.width_px, render.height_px,
                     std::max(int(stills.size()), int(std::lround(seconds * request.frames_per_s))), {}};
  source.frame = [&](int i) { return pictures[std::size_t(std::int64_t(i) * std::int64_t(pictures.size()) / source.count)]; };
  const pov::FrameWatch watch = write_frames(request, source, console);
  FilmRecord record{run.kind, stills.back().still.name, "stills, each held; none in between",
                    Json{{"look", look}, {"pictures", shown}}.dump(), {}};
  finish_film(request, source, watch, std::move(record),
              std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), console);
}

}  // namespace witherfield::cli
