// Keys of the room and the pictures: [room], [stairs], [footprints], [soil], [wear], [view], [[still]],
// [output].
#include "sim/scene/floor_keys.hpp"

#include <algorithm>
#include <cmath>

#include "sim/scene/head_keys.hpp"

namespace witherfield::scene {
namespace {

using namespace floor;

constexpr Limits kPlace{-1000, 1000, "m"};

void polygon(KeyVisitor& v, const Key& key, std::vector<glm::dvec2>& corners) {
  CurveKeys pairs;
  for (const glm::dvec2& p : corners) pairs.emplace_back(p.x, p.y);
  v.pairs(key, pairs, kPlace, kPlace);
  corners.clear();
  for (const auto& [x, y] : pairs) corners.push_back({x, y});
}

void point(KeyVisitor& v, const Key& key, glm::dvec2& p) {
  v.numbers(key, {&p.x, 2}, kPlace, Order::any);
}

/// `from_day` and `until_day`, which may be left out: always.
void stay(KeyVisitor& v, double& from_day, double& until_day) {
  v.number({"from_day", "Stands from this day"}, from_day, {0, 1e6, "days"});
  std::optional<double> until;
  if (std::isfinite(until_day)) until = until_day;
  v.optional_number({"until_day", "Stands until this day; left out: to the end"}, until, {0, 1e6, "days"},
                    365);
  until_day = until.value_or(kForever);
}

void describe_door(KeyVisitor& v, Door& d) {
  v.text({"name", "For messages"}, d.name, {});
  point(v, {"a_m", "One jamb: a place on the wall"}, d.a_m);
  point(v, {"b_m", "The other jamb"}, d.b_m);
  v.number({"share", "Of the visits that begin here, relative to the other doors"}, d.share, {0, 1e6});
}

void describe_obstacle(KeyVisitor& v, RoomOptions& room, std::size_t i, std::vector<double>& height_m) {
  Obstacle& o = room.obstacles[i];
  v.text({"name", "For messages and pictures: desk, column, bench, cupboard ..."}, o.name, {});
  polygon(v, {"outline_m", "Corners"}, o.outline_m);
  if (height_m.size() <= i) height_m.resize(i + 1, 0.74);
  v.number({"height_m", "In pictures"}, height_m[i], {0.05, 10, "m"});
  stay(v, o.from_day, o.until_day);
}

void describe_place(KeyVisitor& v, Place& p) {
  v.text({"name", "For messages"}, p.name, {});
  point(v, {"at_m", "Where one stands or sits down"}, p.at_m);
  v.number({"facing_deg", "Where one looks there, counter-clockwise from x"}, p.facing_deg,
           {-360, 360, "deg"});
  v.number({"share", "Of the round trips, relative to the other places"}, p.share, {0, 1e6});
  v.number({"stay_min", "How long one stays"}, p.stay_min, {0, 1e6, "min"});
  stay(v, p.from_day, p.until_day);
}

void describe_room(KeyVisitor& v, FloorScene& s) {
  RoomOptions& r = s.floor.room;
  polygon(v, {"outline_m", "Corners of the outer wall"}, r.outline_m);
  v.number({"wall_height_m", "In pictures; of stairs: the side walls above the flight"}, s.wall_height_m, {1, 20, "m"});
  v.required_tables(
      {"door", "An opening in the outer wall"}, r.doors.size(), [&](std::size_t n) { r.doors.resize(n); },
      [&](KeyVisitor& k, std::size_t i) { describe_door(k, r.doors[i]); });
  v.tables(
      {"window", "A window in the outer wall: only pictures know it"}, s.windows.size(),
      [&](std::size_t n) { s.windows.resize(n); },
      [&](KeyVisitor& k, std::size_t i) {
        RoomWindow& w = s.windows[i];
        point(k, {"a_m", "One end: a place on the wall"}, w.a_m);
        point(k, {"b_m", "The other end"}, w.b_m);
        k.number({"sill_m", "Height of its lower edge"}, w.sill_m, {0, 10, "m"});
        k.number({"height_m", "From lower to upper edge"}, w.height_m, {0.1, 10, "m"});
      });
  v.tables(
      {"obstacle", "Desk, column, bench: nobody walks through it"}, r.obstacles.size(),
      [&](std::size_t n) { r.obstacles.resize(n); },
      [&](KeyVisitor& k, std::size_t i) { describe_obstacle(k, r, i, s.obstacle_height_m); });
  v.tables(
      {"place", "A goal of round trips"}, r.places.size(), [&](std::size_t n) { r.places.resize(n); },
      [&](KeyVisitor& k, std::size_t i) { describe_place(k, r.places[i]); });
  v.tables(
      {"picture", "On a wall; patrols may stop at it"}, r.pictures.size(),
      [&](std::size_t n) { r.pictures.resize(n); },
      [&](KeyVisitor& k, std::size_t i) {
        k.text({"name", "For messages"}, r.pictures[i].name, {});
        point(k, {"at_m", "A place on the wall"}, r.pictures[i].at_m);
      });
}

void describe_stairs(KeyVisitor& v, StairOptions& s) {
  v.whole({"treads", "Of the flight"}, s.treads, {2, 200});
  v.number({"going_m", "Depth of a tread"}, s.going_m, {0.2, 0.6, "m"});
  v.number({"rise_m", "Height of a step"}, s.rise_m, {0.05, 0.3, "m"});
  v.number({"width_m", "Of the flight"}, s.width_m, {0.6, 20, "m"});
  v.number({"up_share", "Of the visits that go up; the others come down"}, s.up_share, {0, 1});
  v.number({"keep_right_m", "Lane's distance from the middle, to the walker's right"}, s.keep_right_m,
           {0, 10, "m"});
  v.number({"lane_sd_m", "Spread of the lanes"}, s.lane_sd_m, {0, 10, "m"});
  v.number({"speed_m_s", "Along the plan"}, s.speed_m_s, {0.1, 2, "m/s"});
  v.number({"nosing_m", "Zone behind the front edge that carries more"}, s.nosing_m, {0, 0.2, "m"});
  v.number({"nosing_factor", "Wear at the very edge over that further back"}, s.nosing_factor, {1, 10});
}

void describe_view(KeyVisitor& v, RoomStill& s, const std::vector<double>& frames) {
  v.number({"visits_share", "Key frame shown, one of wear.frames"}, s.visits_share, {0, 1});
  v.check("visits_share",
          std::any_of(frames.begin(), frames.end(),
                      [&](double f) { return std::abs(f - s.visits_share) < 1e-9; }),
          [] { return "must be one of wear.frames"; });
  Still& still = s.still;
  int size[2] = {still.width_px, still.height_px};
  v.wholes({"size_px", "Width and height of the picture"}, size, {16, 16384, "pixels"});
  still.width_px = size[0];
  still.height_px = size[1];
  v.numbers({"camera_m", "Position of the camera: x, y in the plan, z above the floor"},
            {&still.camera.position_m.x, 3}, kPlace, Order::any);
  v.numbers({"look_at_m", "Point in the middle of the picture"}, {&still.camera.look_at_m.x, 3}, kPlace,
            Order::any);
  v.check("look_at_m", still.camera.position_m != still.camera.look_at_m,
          [] { return "must differ from camera_m"; });
  v.number({"fov_deg", "Horizontal field of view"}, still.camera.fov_deg, {5, 120, "deg"});
  v.number({"sun_azimuth_deg", "Direction of the sun, counter-clockwise from +x"}, still.sun.azimuth_deg,
           {0, 360, "deg"});
  v.number({"sun_elevation_deg", "Height of the sun"}, still.sun.elevation_deg, {5, 90, "deg"});
  v.number({"exposure", "Factor on the light before tone mapping"}, still.exposure, {0.05, 20});
  v.number({"haze", "Dust in the air that shows the light's shafts; 0 = none"}, s.haze, {0, 1});
  v.number({"relief_scale", "Relief of wear in the picture over the true one"}, s.relief_scale, {0, 1000});
}

void describe_walk(KeyVisitor& v, WalkSources& w) {
  v.texts({"footprints", "footprints.bin of earlier runs: visits that go the same way in this scene are taken from "
                         "there, the others are walked"},
          w.footprint_files, {});
  v.texts({"tracks", "Positions of people over time: JuPedSim or Vadere text, or CSV with person, time_s, x_m, y_m. "
                     "The visits follow them in turn"},
          w.track_files, {});
  v.text({"track_format", "Of those files; guess = by the header"}, w.track_format,
         {"guess", "csv", "jupedsim", "vadere"});
  v.check("tracks", w.track_files.empty() || w.footprint_files.empty(),
          [] { return "cannot be given together with footprints"; });
  std::optional<double> first, last;
  if (w.stretch) first = w.stretch->first, last = w.stretch->second;
  v.optional_number({"from_visit", "This run walks only a stretch of the visits, from this one on ..."}, first,
                    {0, 1e8, "visits"}, 0);
  v.optional_number({"until_visit", "... up to this one, itself left out"}, last, {0, 1e8, "visits"}, 50000);
  if (!first && !last) return;
  w.stretch = {int(first.value_or(0)), int(last.value_or(1e8))};
  v.check("until_visit", w.stretch->first < w.stretch->second, [] { return "must be greater than from_visit"; });
}

}  // namespace

void describe_floor_scene(KeyVisitor& v, FloorTables& t) {
  FloorScene& s = t.scene;
  FloorOptions& o = s.floor;
  v.text({"kind", "What is simulated"}, t.kind, {"floor"});
  describe_head(v, s.name, o.seed);
  v.table({"room", "Plan of the room, metres"}, [&](KeyVisitor& k) { describe_room(k, s); });
  v.optional_table(
      {"stairs", "A straight flight of stairs instead of a room"}, o.stairs.has_value(),
      [&] { o.stairs.emplace(); }, [&](KeyVisitor& k) { describe_stairs(k, *o.stairs); });
  v.check("room", o.stairs || !v.reading() || o.room.outline_m.size() >= 3,
          [] { return "a room needs outline_m with 3 corners or more (or state [stairs])"; });
  v.table({"crowd", "Who comes, how often and what for"}, [&](KeyVisitor& k) { describe_crowd(k, o); });
  v.table({"gait", "How they walk"}, [&](KeyVisitor& k) { describe_gait(k, o.gait); });
  v.table({"footprints", "Soles"}, [&](KeyVisitor& k) {
    k.number({"pixels_per_m", "Resolution of the floor"}, o.footprints.pixels_per_m, {20, 2000, "pixels/m"});
    k.whole({"mask_size", "Edge of a sole's picture, odd; 0 = as large as needed"}, o.footprints.mask_size,
            {0, 1001, "pixels"});
    k.whole({"angle_steps", "Headings of a footprint in a full turn, a multiple of 4"},
            o.footprints.angle_steps, {16, 3600});
    k.whole({"sizes", "Sole lengths for each sex"}, o.footprints.sizes, {1, 9});
    k.texts({"masks", "Pictures of soles of your own (PNG, grey, toe to the right, right foot)"},
            s.mask_files, {});
    k.number({"mask_pixels_per_m", "Resolution of those pictures"}, s.mask_pixels_per_m,
             {10, 5000, "pixels/m"});
  });
  v.table({"walk", "Footprints of earlier runs or of measured people, instead of new walks"},
          [&](KeyVisitor& k) { describe_walk(k, s.walk); });
  v.table({"material", "The floor"}, [&](KeyVisitor& k) { describe_material(k, o.material); });
  v.table({"soil", "Dirt from outside"}, [&](KeyVisitor& k) {
    k.number({"carried", "Dirt that a clean spot gains from a step at the door"}, o.soil.carried, {0, 1});
    k.number({"fades_over_steps", "After which a sole has lost 63 % of its dirt"}, o.soil.fades_over_steps,
             {0.1, 1e4, "steps"});
    k.number({"rubbed", "Share of the dirt that a step takes along"}, o.soil.rubbed, {0, 1});
    k.number({"mopped_per_day", "Share of the dirt"}, o.soil.mopped_per_day, {0, 10, "1/day"});
  });
  v.table({"wear", "Time"}, [&](KeyVisitor& k) {
    k.list({"frames", "Key frames: share of the visits made"}, o.frames, {0, 1}, Order::ascending);
    k.check("frames", !o.frames.empty(), [] { return "at least one key frame is needed"; });
  });
  if (v.reading() && !o.frames.empty()) t.view.visits_share = o.frames.back();
  v.table({"view", "Camera, light and size that all stills start from"},
          [&](KeyVisitor& k) { describe_view(k, t.view, o.frames); });
  v.tables(
      {"still", "A picture. What an entry leaves out is as in [view]"}, s.stills.size(),
      [&](std::size_t n) { s.stills.resize(n, t.view); },
      [&](KeyVisitor& k, std::size_t i) {
        k.text({"name", "File name of the picture: letters a-z, digits and _"}, s.stills[i].still.name, {});
        check_still_name(k, s.stills[i].still.name);
        describe_view(k, s.stills[i], o.frames);
      });
  v.table({"output", "What a run writes"}, [&](KeyVisitor& k) {
    k.flag({"fields", "Write floor/*.vti and floor.pvd"}, s.output.fields);
    k.flag({"footprints",
            "Keep all footprints: footprints.bin (32 bytes each), which [walk] of another run can take"},
           s.output.footprints);
    k.whole({"shown_visits", "Visits in walks.vtp, footprints.vtp and footprints.csv; 0 = no such files"},
            s.output.shown_visits, {0, 1e6, "visits"});
    k.flag({"pov", "Write the POV-Ray scenes of the stills"}, s.output.pov);
    k.text({"compression", "Of the VTK files: fast, or small"}, s.output.compression, {"lz4", "zlib"});
  });
}

}  // namespace witherfield::scene
