// The film of a floor: the room and its light stay, the floor goes through all of the run's key frames.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/film.hpp"
#include "cli/floor_pictures.hpp"
#include "cli/run_scene.hpp"
#include "pov/room_scene.hpp"
#include "pov/tonemap.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/monotone.hpp"
#include "sim/scene/resolved.hpp"
#include "vis/atomic_file.hpp"
#include "vis/floor_read.hpp"

namespace witherfield::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Key frames of the run, read when they are needed; four stay in memory.
class FloorSeries {
 public:
  FloorSeries(const fs::path& folder, const RunSummary& run) {
    for (const FrameRecord& f : run.frames)
      if (const std::string file = f.file("floor"); !file.empty()) {
        moments_.push_back(f.wd);
        days_.push_back(f.time_days);
        files_.push_back(folder / file);
      }
    if (files_.size() < 2)
      throw InvalidInput(fmt::format("'{}' has {} key frame{} of its floor; a film needs 2 or more: see wear.frames "
                                     "and output.fields in the scene file",
                                     folder.string(), files_.size(), files_.size() == 1 ? "" : "s"));
  }
  const std::vector<double>& moments() const { return moments_; }
  double days(double moment) const {
    return days_.back() * (moments_.back() > 0 ? moment / moments_.back() : 0);
  }
  FloorField at(double moment) {
    const KeyPlace place = place_among(moments_, moment);
    const auto exact = std::find(moments_.begin(), moments_.end(), moment);
    if (exact != moments_.end()) return key(std::size_t(exact - moments_.begin()));
    const std::size_t first = place.first, keep = first == 0 ? 0 : first - 1;
    std::erase_if(loaded_, [&](const auto& entry) { return entry.first < keep || entry.first > first + 2; });
    const FloorField* keys[4] = {place.window.before ? &key(first - 1) : nullptr, &key(first), &key(first + 1),
                                 place.window.after ? &key(first + 2) : nullptr};
    return floor_between(place.window, keys);
  }

 private:
  const FloorField& key(std::size_t i) {
    const auto found = loaded_.find(i);
    if (found != loaded_.end()) return found->second;
    return loaded_
        .emplace(i, vis::read_floor_vti(files_[i], {"gloss", "dirt", "wear_depth_um", "height_m", "diffuse"}))
        .first->second;
  }
  std::vector<double> moments_, days_;
  std::vector<fs::path> files_;
  std::map<std::size_t, FloorField> loaded_;
};

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Rendered key pictures, kept in film/NAME_keys until the film is whole.
class KeyPictures {
 public:
  KeyPictures(const FilmRequest& request, const scene::FloorScene& scene, const scene::RoomStill& still,
              FloorSeries& series, Console& console)
      : request_(request), scene_(scene), still_(still), series_(series), bar_(console.progress()),
        folder_(request.film_folder() / (still.still.name + "_keys")) {
    const std::string settings = settings_text();
    const fs::path file = folder_ / "settings.json";
    std::error_code error;
    if (request.resume && fs::exists(file)) {
      if (read_text(file) != settings)
        throw InvalidInput(fmt::format("'{}' holds key pictures of another size, quality, scene or program version; "
                                       "they cannot be used. Without --resume the film starts anew",
                                       folder_.string()));
    } else {
      fs::remove_all(folder_, error);
    }
    fs::create_directories(folder_, error);
    if (error) throw IoFailure("cannot make the folder '" + folder_.string() + "': " + error.message());
    if (!fs::exists(file)) vis::write_whole_file(file, settings);
  }

  pov::HdrImage at(double moment) {
    check_interrupted();
    ++count_;
    const fs::path kept = folder_ / fmt::format("key_{:.9f}.hdr", moment);
    if (fs::exists(kept)) return pov::decode_hdr(read_text(kept), kept.string());
    const std::string stage = fmt::format("key picture {}", count_);
    const fs::path scratch = folder_ / "scene";
    const fs::path file = write_scene(scratch, moment);
    pov::HdrImage image;
    try {
      pov::RenderOptions render = request_.render;
      render.even_samples = true;
      image = pov::render_radiance(file, render,
                                   [&](std::string_view, double fraction) { bar_(stage, fraction); })
                  .image;
    } catch (...) {
      std::error_code ignored;
      fs::remove_all(scratch, ignored);
      check_interrupted();  // Ctrl-C has ended povray, too
      throw;
    }
    bar_(stage, 1);
    std::error_code ignored;
    fs::remove_all(scratch, ignored);
    vis::write_whole_file(kept, pov::encode_hdr(image));
    ++rendered_;
    return image;
  }
  int rendered() const { return rendered_; }
  const fs::path& folder() const { return folder_; }
  void remove() const {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

 private:
  std::string settings_text() const {
    return Json{{"version", kProgramVersion},
                {"scene", Json::parse(scene::resolved_json(scene_))},
                {"run_bytes", fs::file_size(request_.folder / "run.json")},
                {"still", still_.still.name},
                {"size_px", {still_.still.width_px, still_.still.height_px}},
                {"quality", int(request_.render.quality)}}
        .dump();
  }
  fs::path write_scene(const fs::path& folder, double moment) {
    const FloorField plan = series_.at(moment);
    if (scene_.floor.stairs) {
      pov::StairSceneInput in = stair_input(
          scene_, still_, treads_of(plan, scene_.floor.stairs->treads, scene_.floor.stairs->going_m));
      in.film = true;
      return pov::write_stair_scene(folder, in);
    }
    pov::RoomSceneInput in = room_input(scene_, still_, plan);
    in.film = true;
    return pov::write_room_scene(folder, in);
  }

  const FilmRequest& request_;
  const scene::FloorScene& scene_;
  const scene::RoomStill& still_;
  FloorSeries& series_;
  Progress bar_;
  fs::path folder_;
  int count_ = 0, rendered_ = 0;
};

scene::RoomStill still_of(const FilmRequest& request, const scene::FloorScene& scene) {
  if (scene.stills.empty())
    throw InvalidInput("'" + request.folder.string() + "' has no stills: add a [[still]] to the scene file, then run it again");
  std::string names;
  const scene::RoomStill* chosen = request.scene.empty() ? &scene.stills.back() : nullptr;
  for (const scene::RoomStill& s : scene.stills) {
    names += (names.empty() ? "" : ", ") + s.still.name;
    if (s.still.name == request.scene) chosen = &s;
  }
  if (!chosen)
    throw InvalidInput("--scene " + request.scene + ": no still of this name in '" + request.folder.string() +
                       "'; there are: " + names);
  scene::RoomStill still = *chosen;
  if (request.width_px > 0) still.still.width_px = request.width_px, still.still.height_px = request.height_px;
  still.still.width_px += still.still.width_px % 2;  // 4:2:0
  still.still.height_px += still.still.height_px % 2;
  return still;
}

/// Frames of the film rendered for comparison, in the middle of the gaps between keys: there the blend is worst.
Json verify(const FilmRequest& request, const pov::KeySet& set, std::span<const double> clock, double exposure,
            KeyPictures& pictures, std::vector<Check>& checks) {
  Json out = Json::array();
  double worst = 0;
  const std::size_t gaps = clock.size() - 1;
  const int n = std::min<int>(request.verify, int(gaps));
  for (int k = 0; k < n; ++k) {
    const std::size_t gap = std::size_t((k + 0.5) * double(gaps) / n);
    const double at = 0.5 * (clock[gap] + clock[gap + 1]), moment = pov::moment_at(set.keys, clock, at);
    const pov::PictureDifference d =
        pov::difference(pov::picture_between(set.keys, clock, at), pictures.at(moment), exposure);
    out.push_back({{"moment", moment}, {"rms", d.rms}, {"mean", d.mean}, {"p999", d.p999}});
    worst = std::max(worst, d.rms);
  }
  if (n > 0) checks.push_back({"verified_error_rms", worst, request.blend_bound, "levels"});
  return out;
}

Json keys_json(const pov::KeySet& set, std::span<const double> clock, const FloorSeries& series) {
  Json out = Json::array();
  for (std::size_t i = 0; i < set.keys.size(); ++i)
    out.push_back({{"visits_share", set.keys[i].moment}, {"time_days", series.days(set.keys[i].moment)}, {"clock", clock[i]}});
  return out;
}

}  // namespace

void film_floor(const FilmRequest& request, const RunSummary& run, Console& console) {
  const auto start = std::chrono::steady_clock::now();
  if (!request.look.empty() && request.look != "room")
    throw InvalidInput("--look " + request.look + ": floors have the look room");
  const scene::FloorScene scene =
      scene::floor_scene_of(read_scene_json(request.folder), (request.folder / "run.json").string());
  const scene::RoomStill still = still_of(request, scene);
  const double exposure = still.still.exposure;
  FloorSeries series(request.folder, run);
  KeyPictures pictures(request, scene, still, series, console);
  const pov::KeySet set = pov::choose_keys(series.moments(), [&](double moment) { return pictures.at(moment); },
                                           {exposure, request.blend_bound, request.max_keys});
  const std::vector<double> clock = pov::film_clock(set.keys, request.pace, exposure);
  FilmRecord record{"floor", still.still.name, "key pictures, interpolated in scene radiance", "{}", {}};
  Json details;
  details["pace"] = request.pace == pov::Pace::even ? "even" : "time";
  details["keys"] = keys_json(set, clock, series);
  details["blend_error_levels"] = {{"rms", set.blend_error.rms}, {"mean", set.blend_error.mean},
                                   {"p999", set.blend_error.p999}, {"at_visits_share", set.worst_moment}};
  record.checks.push_back({"blend_error_rms", set.blend_error.rms, request.blend_bound, "levels"});
  record.checks.push_back({"gaps_not_measured", double(set.gaps_left), 0, ""});
  details["verified"] = verify(request, set, clock, exposure, pictures, record.checks);
  details["pictures_rendered"] = pictures.rendered();

  const double seconds = request.seconds > 0 ? request.seconds : 30;
  FrameSource source{still.still.name, still.still.width_px, still.still.height_px,
                     std::max(2, int(std::lround(seconds * request.frames_per_s))), {}};
  source.frame = [&](int i) {
    return pov::develop(pov::picture_between(set.keys, clock, double(i) / (source.count - 1)), exposure);
  };
  const pov::FrameWatch watch = write_frames(request, source, console);
  record.checks.push_back({"neighbour_difference_p999", double(watch.neighbour_p999()), neighbour_bound(request, source.count), "levels"});
  // Rounding, and the grain of dull mirror images, which goes as it came.
  record.checks.push_back({"difference_from_first_falls_by", watch.largest_fall(), std::max(0.1, 0.02 * watch.from_first()), "levels"});
  record.details = details.dump();
  if (!request.keep_frames) pictures.remove();
  finish_film(request, source, watch, std::move(record),
              std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), console);
}

}  // namespace witherfield::cli
