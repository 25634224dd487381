// witherfield film: frames -> .mp4.
#include <CLI/CLI.hpp>
#include <memory>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/film.hpp"
#include "cli/video_writer.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"

namespace witherfield::cli {
namespace {

constexpr const char* kFilmFooter =
    "\nExamples:\n"
    "  witherfield film out/patrol_gallery --size 640x360          30 s, 25 frames a second: film/gallery_worn.mp4\n"
    "  witherfield film out/patrol_gallery --size 320x180 --seconds 6 --quality draft      a quick look\n"
    "  witherfield film out/patrol_gallery --scene gallery_used --strip strip.png\n"
    "  witherfield film out/hillside --look blades                 its stills, one after another\n\n"
    "Floors: the room stays, its floor goes from the run's first key frame to the last. A few key pictures are\n"
    "rendered with fixed light; those between are interpolated in scene radiance, pixel by pixel, never\n"
    "leaving the range of the two keys beside them, so nothing flickers. Each gap between keys is measured: a picture\n"
    "is rendered inside it and compared with the blend; the gap is divided until they differ by less than\n"
    "--blend-bound (root mean square, levels of 255). The clock is even: the picture changes by the same amount\n"
    "from frame to frame, so early wear, which goes fast, takes its time; --pace time lets visits pass evenly.\n"
    "Checks (exit code 1 when one fails; the film stays): the blend error, the change between neighbouring frames\n"
    "(--bound, 999 of 1000 values), and that the difference from the first frame grows.\n\n"
    "Grass, leaves, fruit: plants move, so nothing is blended; the stills that differ in `wd` alone are shown in\n"
    "the order of their weathering degree, each held for its share of the time.\n\n"
    "Ctrl-C leaves the rendered key pictures in film/NAME_keys; --resume goes on with them.\n"
    "film/NAME.json tells keys, errors and differences. Needs povray and ffmpeg (Debian packages of these names).";

struct FilmOptions {
  std::string folder, scene, look, size, quality = "good", pace = "even", strip;
  FilmRequest request;
};

void film(FilmOptions& o, const bool& quiet) {
  FilmRequest& r = o.request;
  r.folder = o.folder;
  r.scene = o.scene;
  r.look = o.look;
  r.strip = o.strip;
  if (!o.size.empty()) std::tie(r.width_px, r.height_px) = parse_size(o.size);
  if (r.width_px % 2 != 0 || r.height_px % 2 != 0)
    throw InvalidInput("--size " + o.size + ": width and height of a film must be even");
  r.render.quality = o.quality == "draft"  ? pov::Quality::draft
                     : o.quality == "good" ? pov::Quality::good
                                           : pov::Quality::final;
  r.pace = o.pace == "even" ? pov::Pace::even : pov::Pace::time;
  Console console(quiet);
  const ThreadLimit limit(r.render.threads);
  const RunSummary run = read_run(r.folder);
  insist_on_ffmpeg();
  if (run.kind == "floor")
    film_floor(r, run, console);
  else
    film_stills(r, run, console);
}

}  // namespace

void add_film_command(CLI::App& app, const bool& quiet) {
  const auto o = std::make_shared<FilmOptions>();
  FilmRequest& r = o->request;
  CLI::App* c = app.add_subcommand("film", "A film of a run: .mp4 from its first key frame to its last");
  c->footer(kFilmFooter);
  c->add_option("DIR", o->folder, "Folder of a complete run")->required();
  c->add_option("--scene", o->scene, "The still whose camera and light the film has (default: the last)");
  c->add_option("--look", o->look, "Which look (default: the first that the still has)")
      ->check(CLI::IsMember({"texel", "blades", "object", "room"}));
  c->add_option("--size", o->size, "Size instead of the still's; both even")->type_name("WxH");
  c->add_option("--seconds", r.seconds, "Length; 0 = 30 s for floors, half a second a picture else")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  c->add_option("--fps", r.frames_per_s, "Frames a second")->check(CLI::Range(1.0, 120.0))->capture_default_str();
  c->add_option("--quality", o->quality, "Of the key pictures; draft: quick, final: slow and smooth")
      ->check(CLI::IsMember({"draft", "good", "final"}))
      ->capture_default_str();
  c->add_option("--pace", o->pace, "even: the picture changes evenly; time: visits pass evenly (floors)")
      ->check(CLI::IsMember({"even", "time"}))
      ->capture_default_str();
  c->add_option("--blend-bound", r.blend_bound, "Largest blend error, rms, levels of 255 (floors)")
      ->check(CLI::Range(0.05, 50.0))
      ->capture_default_str();
  c->add_option("--keys", r.max_keys, "Most key pictures (floors)")->check(CLI::Range(3, 1000))->capture_default_str();
  c->add_option("--bound", r.neighbour_bound,
                "Largest change between neighbouring frames, of 999 in 1000 values, levels of 255 (floors); "
                "0 = 1 + 1020 / (frames - 1): nothing runs through its range in less than a quarter of the film")
      ->check(CLI::Range(0.0, 255.0))
      ->capture_default_str();
  c->add_option("--verify", r.verify, "Render this many frames between the keys and compare (floors)")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  c->add_option("--strip", o->strip, "Six frames of the film in one picture, half size")->type_name("PNG");
  c->add_flag("--resume", r.resume, "Use the key pictures that a broken-off film of the same settings left");
  c->add_flag("--keep-frames", r.keep_frames, "Keep every frame (film/NAME_frames/*.png) and the key pictures");
  c->add_option("--threads", r.render.threads, "Threads; 0 = all")
      ->check(CLI::Range(0, 512))
      ->capture_default_str();
  c->callback([o, &quiet] { film(*o, quiet); });
}

}  // namespace witherfield::cli
