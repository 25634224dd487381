#include "cli/floor_walk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <sstream>

#include "cli/footprint_file.hpp"
#include "sim/core/errors.hpp"
#include "sim/floor/room.hpp"
#include "sim/floor/tracks.hpp"

namespace witherfield::cli {
namespace {

using floor::Footprint;

floor::Stretch stretch_of(const scene::FloorScene& s) {
  const std::int64_t all = s.floor.crowd.visits;
  if (!s.walk.stretch) return {0, all};
  if (s.walk.stretch->first >= all)
    throw InvalidInput(fmt::format("walk.from_visit = {}: the scene has visits 0 to {}", s.walk.stretch->first, all - 1));
  return {s.walk.stretch->first, std::min<std::int64_t>(s.walk.stretch->second, all)};
}

/// An earlier run's footprints, with the scene that it walked by.
struct EarlierWalk {
  explicit EarlierWalk(const std::string& file) : reader(file), scene(scene::floor_scene_from_text(reader.scene_toml(), file)) {
    // How many soles there were matters, not how they look.
    scene.floor.footprints.masks.assign(scene.mask_files.size(), {"", 3, 250, std::vector<float>(9, 1.0f)});
  }
  FootprintReader reader;
  scene::FloorScene scene;
};

floor::RetuneReport take_and_walk(const scene::FloorScene& s, const floor::Stretch& visits,
                                  const floor::FootprintSink& sink, const Progress& progress) {
  std::vector<std::unique_ptr<EarlierWalk>> earlier;
  std::vector<floor::KeptWalk> kept;
  for (const std::string& file : s.walk.footprint_files) {
    EarlierWalk& walk = *earlier.emplace_back(std::make_unique<EarlierWalk>(file));
    kept.push_back({&walk.scene.floor, walk.reader.visits(), walk.reader.source()});
  }
  return floor::retune(kept, s.floor, visits, sink, progress);
}

std::vector<floor::Track> read_tracks(const scene::FloorScene& s) {
  const std::string& word = s.walk.track_format;
  const floor::TrackFormat format = word == "csv"        ? floor::TrackFormat::csv
                                    : word == "jupedsim" ? floor::TrackFormat::jupedsim
                                    : word == "vadere"   ? floor::TrackFormat::vadere
                                                         : floor::TrackFormat::guess;
  std::vector<floor::Track> all;
  for (const std::string& file : s.walk.track_files) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    if (!in) throw IoFailure("cannot read the tracks '" + file + "' (does the file exist?)");
    std::vector<floor::Track> tracks = floor::parse_tracks(text.str(), format, file);
    const floor::Polygon& outline = s.floor.room.outline_m;
    const bool any = std::any_of(tracks.begin(), tracks.end(), [&](const floor::Track& t) {
      return std::any_of(t.points.begin(), t.points.end(),
                         [&](const floor::TrackPoint& p) { return floor::contains(outline, p.at_m); });
    });
    if (!any)
      throw InvalidInput("walk.tracks: no position in '" + file +
                         "' lies in the room; tracks are in metres, in the plan's own coordinates");
    std::move(tracks.begin(), tracks.end(), std::back_inserter(all));
  }
  return all;
}

/// Visit n follows track n, n - tracks, ...: each time somebody else sets the feet.
floor::RetuneReport follow_tracks(const scene::FloorScene& s, const floor::Stretch& visits,
                                  const floor::FootprintSink& sink, const Progress& progress) {
  if (s.floor.stairs) throw InvalidInput("walk.tracks: stairs take no tracks, only rooms do");
  const std::vector<floor::Track> tracks = read_tracks(s);
  const std::int64_t n = std::int64_t(tracks.size());
  floor::RetuneReport report;
  for (std::int64_t at = visits.first; at < visits.last;) {
    const std::int64_t from = at % n, count = std::min(n - from, visits.last - at);
    floor::footprints_of({tracks.begin() + from, tracks.begin() + from + count}, s.floor,
                         [&](std::span<const Footprint> p) {
                           report.footprints += std::int64_t(p.size());
                           sink(p);
                         },
                         at);
    at += count;
    if (progress) progress("walkers", double(at - visits.first) / double(visits.last - visits.first));
  }
  report.walked = visits.last - visits.first;
  return report;
}

template <class Place>
PointTable table_of(std::span<const Footprint> prints, const Place& place) {
  using Digits = PointTable::Digits;
  PointTable t;
  t.columns = {{"person", Digits::whole, {}}, {"behaviour", Digits::whole, {}}, {"phase", Digits::whole, {}},
               {"foot", Digits::whole, {}},   {"kind", Digits::whole, {}},      {"heading_rad", Digits::single, {}},
               {"weight_N", Digits::single, {}}, {"time_s", Digits::full, {}}};
  for (std::size_t i = 0; i < prints.size(); ++i) {
    const Footprint& f = prints[i];
    t.position_m.push_back(place(i));
    const double values[] = {double(f.person), double(f.behaviour()), double(f.phase()), double(f.foot()),
                             double(f.sole()), f.heading_rad(),       f.weight_N(),      f.time_s};
    for (std::size_t c = 0; c < t.columns.size(); ++c) t.columns[c].values.push_back(values[c]);
  }
  return t;
}

}  // namespace

bool needs_footprint_file(const scene::FloorScene& s) {
  return s.output.footprints || s.walk.stretch || !s.walk.footprint_files.empty() || !s.walk.track_files.empty();
}

floor::RetuneReport write_footprint_file(const scene::FloorScene& s, const std::filesystem::path& file,
                                         const std::function<void()>& interrupted, const Progress& progress) {
  const floor::Stretch visits = stretch_of(s);
  FootprintWriter writer(file, scene::resolved_toml(s), visits);
  const floor::FootprintSink sink = [&](std::span<const Footprint> prints) {
    interrupted();
    writer.write(prints);
  };
  const floor::RetuneReport report = s.walk.track_files.empty() ? take_and_walk(s, visits, sink, progress)
                                                                : follow_tracks(s, visits, sink, progress);
  writer.commit();
  return report;
}

PointTable footprint_table(std::span<const Footprint> prints) {
  return table_of(prints, [&](std::size_t i) { return glm::dvec3(prints[i].x_m, prints[i].y_m, 0); });
}

PointTable walk_table(std::span<const Footprint> prints) {
  PointTable t = table_of(prints, [&](std::size_t i) {
    const std::size_t j = i + 1 < prints.size() && prints[i + 1].person == prints[i].person ? i + 1 : i;
    return 0.5 * (glm::dvec3(prints[i].x_m, prints[i].y_m, 0) + glm::dvec3(prints[j].x_m, prints[j].y_m, 0));
  });
  for (std::size_t i = 0; i < prints.size(); ++i)
    if (i + 1 == prints.size() || prints[i + 1].person != prints[i].person) t.line_ends.push_back(i + 1);
  return t;
}

}  // namespace witherfield::cli
