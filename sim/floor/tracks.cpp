#include "sim/floor/tracks.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/floor/gait.hpp"

namespace witherfield::floor {
namespace {

constexpr double kStandsBelow_m_s = 0.15;
constexpr double kStandsAtLeast_s = 0.5;
constexpr double kSharpTurn_rad = 0.3;

class Lines {
 public:
  Lines(std::string_view text, std::string_view source) : text_(text), source_(source) {}

  bool next() {
    if (text_.empty()) return false;
    const std::size_t end = text_.find('\n');
    line_ = text_.substr(0, end);
    if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
    text_ = end == std::string_view::npos ? std::string_view{} : text_.substr(end + 1);
    ++number_;
    words_.clear();
    for (std::size_t at = 0; at < line_.size();) {
      const std::size_t from = line_.find_first_not_of(" \t,;", at);
      if (from == std::string_view::npos) break;
      at = std::min(line_.find_first_of(" \t,;", from), line_.size());
      words_.push_back(line_.substr(from, at - from));
    }
    return true;
  }
  std::string_view line() const { return line_; }
  const std::vector<std::string_view>& words() const { return words_; }
  bool is_number(std::size_t word) const {
    double unused;
    return word < words_.size() && read(words_[word], unused);
  }
  double number(std::size_t word, const char* what) const {
    double value = 0;
    if (word >= words_.size()) fail(std::string(what) + " is missing (column " + std::to_string(word + 1) + ")");
    if (!read(words_[word], value))
      fail(std::string(what) + " '" + std::string(words_[word]) + "' is not a number");
    return value;
  }
  [[noreturn]] void fail(const std::string& why) const {
    throw InvalidInput(std::string(source_) + ":" + std::to_string(number_) + ": " + why);
  }

 private:
  static bool read(std::string_view word, double& value) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() && std::isfinite(value);
  }
  std::string_view text_, source_, line_;
  std::vector<std::string_view> words_;
  int number_ = 0;
};

using ByPerson = std::map<std::int64_t, std::vector<TrackPoint>>;

TrackFormat guess(std::string_view text) {
  const std::string_view head = text.substr(0, 2000);
  if (head.find("PID") != std::string_view::npos) return TrackFormat::vadere;
  if (head.find("framerate") != std::string_view::npos || (!head.empty() && head.front() == '#')) return TrackFormat::jupedsim;
  return TrackFormat::csv;
}

void parse_csv(Lines& in, ByPerson& out) {
  for (bool first = true; in.next(); first = false) {
    if (in.words().empty() || in.line().front() == '#' || (first && !in.is_number(0))) continue;
    out[std::int64_t(in.number(0, "person"))].push_back({in.number(1, "time_s"), {in.number(2, "x_m"), in.number(3, "y_m")}});
  }
}

void parse_jupedsim(Lines& in, ByPerson& out) {
  double rate = 0;
  while (in.next()) {
    if (in.words().empty()) continue;
    if (in.line().front() == '#') {
      if (const std::size_t at = in.line().find("framerate"); at != std::string_view::npos)
        for (std::size_t w = 0; w < in.words().size(); ++w)
          if (in.is_number(w)) rate = in.number(w, "framerate");
      continue;
    }
    if (!in.is_number(0)) continue;  // a header without '#'
    if (!(rate > 0)) in.fail("no '# framerate: N' (frames per second) before the first position");
    out[std::int64_t(in.number(0, "id"))].push_back({in.number(1, "frame") / rate, {in.number(2, "x"), in.number(3, "y")}});
  }
}

void parse_vadere(Lines& in, ByPerson& out) {
  if (!in.next()) return;
  std::map<std::string, std::size_t, std::less<>> column;
  for (std::size_t w = 0; w < in.words().size(); ++w)
    column[std::string(in.words()[w].substr(0, in.words()[w].find("-PID")))] = w;
  const auto at = [&](const char* name) {
    if (const auto found = column.find(name); found != column.end()) return found->second;
    in.fail(std::string("the header has no column ") + name);
  };
  const std::size_t person = at("pedestrianId");
  const bool steps = column.contains("simTime");  // each line a footstep from start to end; else a sampled position
  const std::size_t time = steps ? at("simTime") : column.contains("timeStep") ? at("timeStep") : at("time");
  const std::size_t x = at(steps ? "startX" : "x"), y = at(steps ? "startY" : "y");
  while (in.next()) {
    if (in.words().empty()) continue;
    std::vector<TrackPoint>& points = out[std::int64_t(in.number(person, "pedestrianId"))];
    points.push_back({in.number(time, "time"), {in.number(x, "x"), in.number(y, "y")}});
    if (steps && column.contains("endTime"))
      points.push_back({in.number(at("endTime"), "endTime"), {in.number(at("endX"), "endX"), in.number(at("endY"), "endY")}});
  }
}

/// Walks along one track by arc length.
class Along {
 public:
  explicit Along(const Track& track) : points_(track.points) {}

  /// Moves on by length_m. False at the end. Pauses on the way are put into `stood_s`.
  bool go(double length_m, double& stood_s) {
    stood_s = 0;
    while (segment_ + 1 < points_.size()) {
      const TrackPoint &a = points_[segment_], &b = points_[segment_ + 1];
      const double all = glm::distance(a.at_m, b.at_m), left = all * (1 - share_), dt = b.time_s - a.time_s;
      if (dt > 0 && all < kStandsBelow_m_s * dt) stood_s += dt * (1 - share_);
      if (left > length_m) {
        share_ += length_m / all;
        return true;
      }
      length_m -= left;
      share_ = 0;
      ++segment_;
    }
    return false;
  }
  glm::dvec2 at() const { return mix(&TrackPoint::at_m); }
  double time_s() const { return mix(&TrackPoint::time_s); }

 private:
  template <class T>
  T mix(T TrackPoint::*what) const {
    if (segment_ + 1 >= points_.size()) return points_.back().*what;
    return (1 - share_) * (points_[segment_].*what) + share_ * (points_[segment_ + 1].*what);
  }
  const std::vector<TrackPoint>& points_;
  std::size_t segment_ = 0;
  double share_ = 0;
};

std::vector<Step> steps_of(const Track& track, const FloorOptions& options, const Visit& visit) {
  std::vector<Step> steps;
  if (track.points.size() < 2) return steps;
  Gait gait(options, visit);
  Along along(track);
  Body body;
  body.next = gait.random().uniform() < 0.5 ? Foot::left : Foot::right;
  body.at_m = along.at();
  body.time_s = along.time_s();
  double speed = visit.speed_m_s, length = gait.step_length_m(speed) * gait.random().uniform(0.1, 1.0), stood = 0;
  bool first = true;
  while (along.go(length, stood)) {
    const glm::dvec2 d = along.at() - body.at_m;
    const double way = glm::length(d), dt = along.time_s() - stood - body.time_s;
    const double before = body.heading_rad;
    if (way > 1e-6) body.heading_rad = std::atan2(d.y, d.x);
    const double turned = first ? 0 : std::abs(std::remainder(body.heading_rad - before, 6.283185307179586));
    if (stood >= kStandsAtLeast_s)
      for (int foot = 0; foot < 2; ++foot) {
        steps.push_back(gait.set_foot(body, Phase::stand, 0, speed, turned / 2));
        steps.back().contact_s = stood;
      }
    if (dt > 1e-3) speed = std::clamp(length / dt, 0.2, 4.0);
    body.at_m = along.at();
    body.time_s = along.time_s();
    steps.push_back(gait.set_foot(body, Phase::out, length, speed, turned > kSharpTurn_rad ? turned : 0));
    length = gait.step_length_m(speed);
    first = false;
  }
  return steps;
}

}  // namespace

std::vector<Track> parse_tracks(std::string_view text, TrackFormat format, std::string_view source) {
  ByPerson by_person;
  Lines lines(text, source);
  if (format == TrackFormat::guess) format = guess(text);
  if (format == TrackFormat::csv) parse_csv(lines, by_person);
  if (format == TrackFormat::jupedsim) parse_jupedsim(lines, by_person);
  if (format == TrackFormat::vadere) parse_vadere(lines, by_person);
  std::vector<Track> tracks;
  for (auto& [person, points] : by_person) {
    std::stable_sort(points.begin(), points.end(), [](const TrackPoint& a, const TrackPoint& b) { return a.time_s < b.time_s; });
    tracks.push_back({person, std::move(points)});
  }
  if (tracks.empty()) throw InvalidInput(std::string(source) + ": no positions in it");
  return tracks;
}

void footprints_of(const std::vector<Track>& tracks, const FloorOptions& options, const FootprintSink& sink,
                   std::int64_t first_visit) {
  FloorOptions who = options;  // the draws of a person must not depend on how many visits the scene has
  who.stairs.reset();
  std::vector<Footprint> prints;
  for (std::size_t n = 0; n < tracks.size(); ++n) {
    const Visit visit = plan_person(who, first_visit + std::int64_t(n));
    for (const Step& s : steps_of(tracks[n], who, visit))
      prints.push_back(pack(s, std::uint32_t(visit.number), visit.weight_N(), visit.foot_length_m, sole_of(who, visit, s),
                            Behaviour::pass));
    if (prints.size() >= 65536) sink(prints), prints.clear();
  }
  if (!prints.empty()) sink(prints);
}

}  // namespace witherfield::floor
