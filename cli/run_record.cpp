#include "cli/run_record.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/commands.hpp"
#include "cli/run_scene.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"

namespace witherfield::cli {
namespace {

using Json = nlohmann::ordered_json;

/// {"water": [lo, hi], ...}: what pictures take their colour scales from.
Json ranges_json(const vis::ValueRanges& ranges) {
  Json out = Json::object();
  for (const auto& [name, r] : ranges) out[name] = {r.lo, r.hi};
  return out;
}

Json units_json(const vis::ValueRanges& ranges) {
  Json out = Json::object();
  for (const auto& [name, r] : ranges) out[name] = std::string(field_spec(name).unit);
  return out;
}

Json frame_json(const FrameRecord& f) {
  Json out{{"variant", f.variant}, {"index", f.index}, {"wd", f.wd}, {"time_days", f.time_days}};
  out["files"] = Json::object();
  for (const auto& [series, path] : f.files) out["files"][series] = path;
  out["numbers"] = Json::object();
  for (const auto& [name, value] : f.numbers) out["numbers"][name] = value;
  out["ranges"] = ranges_json(f.ranges);
  return out;
}

FrameRecord frame_from(const Json& j) {
  FrameRecord f;
  j.at("variant").get_to(f.variant);
  j.at("index").get_to(f.index);
  j.at("wd").get_to(f.wd);
  j.at("time_days").get_to(f.time_days);
  for (const auto& [series, path] : j.at("files").items())
    f.files.emplace_back(series, path.get<std::string>());
  for (const auto& [name, value] : j.at("numbers").items()) f.numbers.emplace_back(name, value.get<double>());
  for (const auto& [name, r] : j.at("ranges").items())
    f.ranges[name] = {r.at(0).get<double>(), r.at(1).get<double>()};
  return f;
}

Json still_json(const StillRecord& s) {
  const Still& still = s.still;
  Json out{{"name", still.name}, {"wd", still.wd}, {"size_px", {still.width_px, still.height_px}}};
  const glm::dvec3& p = still.camera.position_m;
  out["camera_m"] = {p.x, p.y, p.z};  // with the terrain's height resolved
  out["scenes"] = Json::object();
  for (const auto& [look, file] : s.scenes) out["scenes"][look] = file;
  return out;
}

Json checks_json(const RunRecord& run) {
  Json out = Json::object();
  for (const Check& c : run.checks) {
    out[c.name] = {{"value", c.value}, {"limit", c.limit}, {"passed", c.passed()}};
    if (!c.unit.empty()) out[c.name]["unit"] = c.unit;
  }
  return out;
}

Json parse_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw IoFailure("cannot open '" + file.string() + "'");
  std::ostringstream text;
  text << in.rdbuf();
  return Json::parse(text.str());
}

StillRecord still_from(const Json& j) {
  StillRecord s;
  j.at("name").get_to(s.still.name);
  j.at("wd").get_to(s.still.wd);
  j.at("size_px").at(0).get_to(s.still.width_px);
  j.at("size_px").at(1).get_to(s.still.height_px);
  s.still.looks.clear();
  for (const auto& [look, file] : j.at("scenes").items()) {
    s.still.looks.push_back(look);
    s.scenes.emplace_back(look, file.get<std::string>());
  }
  return s;
}

}  // namespace

std::string FrameRecord::file(const std::string& series) const {
  for (const auto& [name, path] : files)
    if (name == series) return path;
  return "";
}

std::string run_signature(const std::string& scene_json) {
  return Json{{"program", "witherfield"}, {"version", kProgramVersion}, {"scene", Json::parse(scene_json)}}
             .dump(2) +
         "\n";
}

std::string partial_json(const std::vector<FrameRecord>& frames) {
  Json list = Json::array();
  for (const FrameRecord& f : frames) list.push_back(frame_json(f));
  return Json{{"frames", list}}.dump(1) + "\n";
}

std::vector<FrameRecord> read_partial(const std::filesystem::path& file) {
  std::vector<FrameRecord> frames;
  if (!std::filesystem::exists(file)) return frames;
  try {
    const Json partial = parse_file(file);
    for (const Json& f : partial.at("frames")) frames.push_back(frame_from(f));
  } catch (const nlohmann::json::exception& e) {
    throw IoFailure("'" + file.string() + "' cannot be understood (" + e.what() +
                    "); --force starts the run anew");
  }
  return frames;
}

vis::ValueRanges ranges_of(const RunRecord& run) {
  vis::ValueRanges all;
  for (const FrameRecord& f : run.frames) vis::merge_ranges(all, f.ranges);
  return all;
}

std::string run_json(const RunRecord& run) {
  Json j{{"program", "witherfield"},     {"version", kProgramVersion}, {"kind", run.kind},
         {"scene_file", run.scene_file}, {"preview", run.preview},     {"threads", run.threads}};
  j["scene"] = Json::parse(run.scene_json);
  j["seed"] = j["scene"]["seed"];
  double seconds = 0, peak = 0;
  j["stages"] = Json::array();
  for (const StageRecord& s : run.stages) {
    j["stages"].push_back({{"name", s.name}, {"seconds", s.seconds}, {"peak_memory_MiB", s.peak_memory_MiB}});
    seconds += s.seconds;
    peak = std::max(peak, s.peak_memory_MiB);
  }
  j["seconds"] = seconds;
  j["peak_memory_MiB"] = peak;
  for (const auto& [name, text] : run.details) j[name] = Json::parse(text);
  j["value_ranges"] = ranges_json(ranges_of(run));
  j["units"] = units_json(ranges_of(run));
  j["checks"] = checks_json(run);
  j["frames"] = Json::array();
  for (const FrameRecord& f : run.frames) j["frames"].push_back(frame_json(f));
  j["stills"] = Json::array();
  for (const StillRecord& s : run.stills) j["stills"].push_back(still_json(s));
  j["files"] = Json::array();
  for (const auto& [path, bytes] : run.files) j["files"].push_back({{"path", path}, {"bytes", bytes}});
  return j.dump(2) + "\n";
}

std::string read_scene_json(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "run.json";
  try {
    return parse_file(file).at("scene").dump();
  } catch (const nlohmann::json::exception& e) {
    throw IoFailure("'" + file.string() + "' cannot be understood: " + e.what());
  }
}

RunSummary read_run(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "run.json";
  if (!std::filesystem::exists(file)) {
    const std::string where = folder.string();
    std::string hint;
    if (std::filesystem::exists(folder / "scene.resolved.json"))
      hint =
          fmt::format("; it was broken off: `witherfield run SCENE.toml -o {} --resume` finishes it", where);
    throw IoFailure(fmt::format("'{}' holds no complete run (no run.json){}", where, hint));
  }
  try {
    const Json j = parse_file(file);
    RunSummary s;
    s.kind = j.at("kind").get<std::string>();
    s.name = j.at("scene").at("name").get<std::string>();
    s.version = j.at("version").get<std::string>();
    s.seed_text = j.at("seed").dump();
    for (const Json& f : j.at("frames")) s.frames.push_back(frame_from(f));
    for (const Json& still : j.at("stills")) s.stills.push_back(still_from(still));
    j.at("seconds").get_to(s.seconds);
    j.at("peak_memory_MiB").get_to(s.peak_memory_MiB);
    for (const Json& f : j.at("files")) s.bytes += f.at("bytes").get<std::uintmax_t>();
    for (const auto& [name, check] : j.at("checks").items())
      s.checks.emplace_back(name, check.at("passed").get<bool>());
    return s;
  } catch (const nlohmann::json::exception& e) {
    throw IoFailure("'" + file.string() + "' cannot be understood: " + e.what());
  }
}

}  // namespace witherfield::cli
