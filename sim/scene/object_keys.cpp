#include "sim/scene/object_keys.hpp"

#include <algorithm>
#include <cmath>

#include "sim/scene/head_keys.hpp"

namespace witherfield::scene {
namespace {

constexpr int kPreviewPx = 240;

std::string frames_text(const std::vector<double>& frames) {
  std::string text = "[";
  for (const double wd : frames) text += (text.size() > 1 ? ", " : "") + number_text(wd);
  return text + "]";
}

bool all_among(const std::vector<double>& wanted, const std::vector<double>& frames) {
  return std::all_of(wanted.begin(), wanted.end(), [&](double wd) {
    return std::any_of(frames.begin(), frames.end(), [&](double f) { return std::abs(f - wd) < 1e-9; });
  });
}

void describe_camera(KeyVisitor& v, ObjectStill& s) {
  v.number({"azimuth_deg", "Where the camera stands, counter-clockwise from +x; 270 = in front"},
           s.azimuth_deg, {0, 360, "deg"});
  v.number({"elevation_deg", "Height of the camera above the horizon"}, s.elevation_deg, {-89, 89.9, "deg"});
  v.number({"fov_deg", "Horizontal field of view: small = as with a long lens"}, s.fov_deg, {1, 120, "deg"});
  v.number({"margin", "Share of the picture kept free at each edge"}, s.margin, {0, 0.45});
  v.number({"zoom", "Above 1: nearer, for details"}, s.zoom, {0.1, 50});
  v.number({"raise", "Middle of the picture above the object's middle, in heights of the object"}, s.raise,
           {-1, 1});
  v.number({"aperture_m", "Aperture for depth of field; 0 = all sharp"}, s.aperture_m, {0, 0.2, "m"});
}

void describe_light(KeyVisitor& v, ObjectStill& s) {
  v.text({"backdrop", "Light paper, black velvet, or a bright sky behind"}, s.backdrop,
         {"paper", "dark", "sky"});
  v.number({"key_azimuth_deg", "Where the softbox stands, counter-clockwise from +x"}, s.key_azimuth_deg,
           {0, 360, "deg"});
  v.number({"key_elevation_deg", "Height of the softbox"}, s.key_elevation_deg, {5, 90, "deg"});
  v.number({"key_size", "Side of the softbox over the object's size: small = hard shadows"}, s.key_size,
           {0.05, 4});
  v.number({"fill", "Light of the room over that of the softbox"}, s.fill, {0, 4});
  v.number({"rim", "Light from behind over that of the softbox"}, s.rim, {0, 4});
  v.number({"exposure", "Factor on the light before tone mapping"}, s.exposure, {0.05, 20});
}

}  // namespace

void describe_object_view(KeyVisitor& v, ObjectStill& s, const ObjectChoices& choices,
                          const std::vector<double>& frames) {
  v.list({"wd", "Key frames shown, side by side from the left; each one of the run's frames"}, s.wd, {0, 1},
         Order::any);
  v.check("wd", !s.wd.empty() && (frames.empty() || all_among(s.wd, frames)),
          [&] { return "must be one or more of the frames " + frames_text(frames); });
  v.text({"subject", "What is shown"}, s.subject, choices.subjects);
  v.texts({"hide", "Organs left out"}, s.hide, choices.organs);
  int size[2] = {s.width_px, s.height_px};
  v.wholes({"size_px", "Width and height of the picture"}, size, {16, 16384, "pixels"});
  s.width_px = size[0];
  s.height_px = size[1];
  v.number({"pitch_deg", "The object turned about y: 90 = lying along x"}, s.pitch_deg, {-180, 180, "deg"});
  v.number({"yaw_deg", "Then turned about the vertical"}, s.yaw_deg, {-360, 360, "deg"});
  v.number({"gap", "Between objects side by side, in widths of the object"}, s.gap, {0, 5});
  describe_camera(v, s);
  describe_light(v, s);
}

void describe_object_still(KeyVisitor& v, std::vector<ObjectStill>& stills, std::size_t index,
                           const ObjectChoices& choices, const std::vector<double>& frames) {
  ObjectStill& still = stills[index];
  v.text({"name", "File name of the picture: letters a-z, digits and _"}, still.name, {});
  check_still_name(v, still.name);
  v.check("name",
          std::none_of(stills.begin(), stills.begin() + std::ptrdiff_t(index),
                       [&](const ObjectStill& o) { return o.name == still.name; }),
          [] { return "two stills must not have the same name"; });
  describe_object_view(v, still, choices, frames);
}

void shrink_stills(std::vector<ObjectStill>& stills) {
  for (ObjectStill& s : stills) {
    const double factor = std::min(1.0, double(kPreviewPx) / std::max(s.width_px, s.height_px));
    s.width_px = std::max(16, int(s.width_px * factor));
    s.height_px = std::max(16, int(s.height_px * factor));
  }
}

}  // namespace witherfield::scene
