// witherfield film, in parts: what is filmed (a floor that wears, or the stills of a run in their order), and the frames
// on their way to the file.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/run_record.hpp"
#include "pov/film.hpp"
#include "pov/render.hpp"

namespace CLI {
class App;
}

namespace witherfield::cli {

class Console;

/// As those in cli/commands.hpp.
void add_film_command(CLI::App& app, const bool& quiet);

struct FilmRequest {
  std::filesystem::path folder;  ///< of the run
  std::string scene, look;       ///< "" = the last still, its first look
  int width_px = 0, height_px = 0;  ///< 0 = as the still
  pov::RenderOptions render;     ///< quality, threads
  double seconds = 0;            ///< 0 = 30 for floors, half a second a picture else
  double frames_per_s = 25;
  pov::Pace pace = pov::Pace::even;
  double blend_bound = 1;        ///< levels, rms
  int max_keys = 33;
  double neighbour_bound = 0;    ///< levels; 0 = as the length of the film asks
  int verify = 0;                ///< frames to be rendered for comparison
  bool resume = false, keep_frames = false;
  std::filesystem::path strip;   ///< "" = none

  std::filesystem::path film_folder() const { return folder / "film"; }
};

/// Frames in their order, 8-bit sRGB.
struct FrameSource {
  std::string name;  ///< of the film
  int width_px = 0, height_px = 0, count = 0;
  std::function<std::vector<std::uint8_t>(int frame)> frame;
};
/// film/NAME.mp4, with --keep-frames film/NAME_frames/frame_NNNN.png, with --strip six of them in one picture.
/// @throws IoFailure, Interrupted; nothing half-written stays.
pov::FrameWatch write_frames(const FilmRequest& request, const FrameSource& source, Console& console);

/// What film/NAME.json tells beside the frames' own statistics.
struct FilmRecord {
  std::string kind, still, method;
  std::string details = "{}";      ///< JSON object of this kind of film
  std::vector<Check> checks;
};
/// Adds the checks that all films have, writes film/NAME.json, prints the summary.
/// @throws IoFailure; Error with exit code 1 when the film is whole but a check failed.
void finish_film(const FilmRequest& request, const FrameSource& source, const pov::FrameWatch& watch, FilmRecord record,
                 double seconds, Console& console);

/// Kind floor: the floor of a still from the run's first key frame to its last.
void film_floor(const FilmRequest& request, const RunSummary& run, Console& console);
/// Other kinds: stills that differ in their time alone, one after another, none invented in between.
void film_stills(const FilmRequest& request, const RunSummary& run, Console& console);

/// Largest change between neighbouring frames that passes for 999 of 1000 values: going through all 256 levels takes at
/// least a quarter of the film; one level for rounding.
double neighbour_bound(const FilmRequest& request, int frames);

}  // namespace witherfield::cli
