// Frames -> encoder, statistics, pictures beside the film.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/film.hpp"
#include "cli/video_writer.hpp"
#include "pov/png.hpp"
#include "sim/core/colour.hpp"
#include "sim/core/errors.hpp"
#include "vis/atomic_file.hpp"

namespace witherfield::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kStripPictures = 6, kStripColumns = 3, kStripGap_px = 6;

/// Six frames at half size, three to a row, from the first to the last.
class Strip {
 public:
  explicit Strip(const FrameSource& s)
      : source_(s), width_(s.width_px / 2), height_(s.height_px / 2),
        columns_(std::min(kStripColumns, s.count)), pictures_(std::min(kStripPictures, s.count)) {
    rows_ = (pictures_ + columns_ - 1) / columns_;
    full_width_ = columns_ * width_ + (columns_ - 1) * kStripGap_px;
    full_height_ = rows_ * height_ + (rows_ - 1) * kStripGap_px;
    rgb_.assign(3 * std::size_t(full_width_) * std::size_t(full_height_), 255);
  }
  void add(int frame, const std::vector<std::uint8_t>& rgb) {
    for (int k = 0; k < pictures_; ++k)
      if (frame == frame_of(k)) place(k, rgb);
  }
  void write(const fs::path& png) const {
    std::error_code ignored;
    if (png.has_parent_path()) fs::create_directories(png.parent_path(), ignored);
    pov::write_png(png, full_width_, full_height_, rgb_, {{"Software", "witherfield"}, {"Title", source_.name}});
  }

 private:
  int frame_of(int k) const {
    return pictures_ < 2 ? 0 : int(std::lround(double(k) * (source_.count - 1) / (pictures_ - 1)));
  }
  void place(int k, const std::vector<std::uint8_t>& rgb) {
    const int left = k % columns_ * (width_ + kStripGap_px), top = k / columns_ * (height_ + kStripGap_px);
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        for (int c = 0; c < 3; ++c) {
          double sum = 0;  // of light, not of levels
          for (int q = 0; q < 4; ++q) {
            const std::size_t at = std::size_t(2 * y + q / 2) * std::size_t(source_.width_px) + std::size_t(2 * x + q % 2);
            sum += srgb_decode(rgb[3 * at + std::size_t(c)] / 255.0);
          }
          const std::size_t to = std::size_t(top + y) * std::size_t(full_width_) + std::size_t(left + x);
          rgb_[3 * to + std::size_t(c)] = std::uint8_t(std::lround(255 * srgb_encode(sum / 4)));
        }
  }

  const FrameSource& source_;
  int width_, height_, columns_, pictures_, rows_ = 1, full_width_ = 0, full_height_ = 0;
  std::vector<std::uint8_t> rgb_;
};

/// The growth in tenths of the film: mean levels from the first frame.
Json growth_json(const pov::FrameWatch& watch) {
  Json out = Json::array();
  const int last = watch.frames() - 1;
  for (int tenth = 0; tenth <= 10 && last >= 0; ++tenth)
    out.push_back(watch.growth()[std::size_t(std::lround(0.1 * tenth * last))]);
  return out;
}

Json checks_json(const std::vector<Check>& checks) {
  Json out = Json::object();
  for (const Check& c : checks)
    out[c.name] = {{"value", c.value}, {"limit", c.limit}, {"passed", c.passed()}, {"unit", c.unit}};
  return out;
}

}  // namespace

double neighbour_bound(const FilmRequest& request, int frames) {
  if (request.neighbour_bound > 0) return request.neighbour_bound;
  return 1 + 4 * 255.0 / std::max(1, frames - 1);
}

pov::FrameWatch write_frames(const FilmRequest& request, const FrameSource& source, Console& console) {
  const fs::path frames = request.film_folder() / (source.name + "_frames");
  std::error_code error;
  fs::remove_all(frames, error);
  fs::create_directories(request.keep_frames ? frames : request.film_folder(), error);
  if (error) throw IoFailure("cannot make the folder '" + request.film_folder().string() + "': " + error.message());
  pov::FrameWatch watch;
  const auto strip = request.strip.empty() ? nullptr : std::make_unique<Strip>(source);
  VideoWriter video(request.film_folder() / (source.name + ".mp4"), source.width_px, source.height_px,
                    request.frames_per_s);
  const Progress bar = console.progress();
  try {
    for (int i = 0; i < source.count; ++i) {
      check_interrupted();
      const std::vector<std::uint8_t> rgb = source.frame(i);
      watch.add(rgb);
      video.frame(rgb);
      if (strip) strip->add(i, rgb);
      if (request.keep_frames)
        pov::write_png(frames / fmt::format("frame_{:04}.png", i), source.width_px, source.height_px, rgb);
      bar("frames of " + source.name, double(i + 1) / source.count);
    }
  } catch (...) {
    fs::remove_all(frames, error);
    throw;
  }
  video.finish();
  if (strip) strip->write(request.strip);
  return watch;
}

void finish_film(const FilmRequest& request, const FrameSource& source, const pov::FrameWatch& watch, FilmRecord record,
                 double seconds, Console& console) {
  const fs::path film = request.film_folder() / (source.name + ".mp4");
  Json j{{"program", "witherfield"}, {"version", kProgramVersion}, {"kind", record.kind}, {"still", record.still},
         {"method", record.method}};
  j["size_px"] = {source.width_px, source.height_px};
  j["frames"] = source.count;
  j["frames_per_s"] = request.frames_per_s;
  j["seconds"] = source.count / request.frames_per_s;
  j["bytes"] = fs::file_size(film);
  j["made_in_s"] = seconds;
  j["neighbour_difference_levels"] = {{"p999", watch.neighbour_p999()}, {"largest", watch.neighbour_max()}, {"mean_largest", watch.neighbour_mean_max()}};
  j["difference_from_first_levels"] = growth_json(watch);
  j["detour"] = watch.detour();
  j.update(Json::parse(record.details));
  j["checks"] = checks_json(record.checks);
  vis::write_whole_file(request.film_folder() / (source.name + ".json"), j.dump(2) + "\n");
  console.say(fmt::format("{}: {} frames, {:g} s, {}; made in {}", film.string(), source.count,
                          source.count / request.frames_per_s, size_text(double(fs::file_size(film))),
                          duration_text(seconds)));
  std::string failed;
  for (const Check& c : record.checks) {
    console.say(fmt::format("  {}: {:.3g}{}{}, bound {:.3g}", c.name, c.value, c.unit.empty() ? "" : " ", c.unit, c.limit));
    if (!c.passed())
      failed += fmt::format("{}{} is {:.4g} {}, the bound is {:.4g}", failed.empty() ? "" : "; ", c.name, c.value,
                            c.unit, c.limit);
  }
  if (!failed.empty())
    throw Error(fmt::format("the film {} is complete, but a check failed: {}", film.string(), failed), 1);
}

}  // namespace witherfield::cli
