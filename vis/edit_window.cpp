#include "vis/edit_window.hpp"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/core/errors.hpp"
#include "vis/edit_camera.hpp"
#include "vis/edit_markers.hpp"
#include "vis/edit_panels.hpp"
#include "vis/edit_surface.hpp"
#include "vis/legend.hpp"
#include "vis/vtk_messages.hpp"
#include "vis/x_events.hpp"

namespace witherfield::vis {

bool x_display_can_render();  // x_display.cpp

namespace {

using Clock = std::chrono::steady_clock;
double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

constexpr double kReach_px = 13;     // from a marker's middle at which the pointer takes it
constexpr double kSettle_s = 0.18;   // after the last movement the picture is drawn once more, at full quality
constexpr double kTurn_s = 0.04;     // longest sleep of the loop
constexpr double kRecent_s = 0.75;   // over which frames a second are averaged

struct Box {
  glm::dvec3 lo{0.0}, hi{0.0};
  bool empty = true;
  void add(const glm::dvec3& p) {
    lo = empty ? p : glm::min(lo, p);
    hi = empty ? p : glm::max(hi, p);
    empty = false;
  }
  glm::dvec3 middle() const { return 0.5 * (lo + hi); }
  double radius() const { return 0.5 * glm::distance(lo, hi); }
};

/// Legend of a field at the right side.
struct Bar {
  ColourMap map;
  std::string title, unit;
};

void check(const EditWindowOptions& o) {
  const auto in = [](const char* what, int value, int lo, int hi) {
    if (value < lo || value > hi)
      throw InvalidInput(std::string("edit window: ") + what + " " + std::to_string(value) + " is outside " +
                         std::to_string(lo) + ".." + std::to_string(hi));
  };
  in("width", o.width_px, 480, 8192);
  in("height", o.height_px, 360, 8192);
  in("samples", o.samples, 0, 16);
  in("samples while moving", o.moving_samples, 0, 16);
}

}  // namespace

struct EditWindow::Impl {
  enum class Dragging { nothing, client, turning, shifting };

  EditWindowOptions options;
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> back, front, side;  ///< surface; markers and text; colour bar
  vtkNew<vtkCamera> camera;
  std::unique_ptr<EditSurface> surface, beside;
  std::unique_ptr<EditMarkers> markers;
  std::unique_ptr<EditPanels> panels;
  std::unique_ptr<XEvents> events;
  EditCamera eye;
  std::optional<Bar> bar;
  bool bar_is_new = false;

  int width = 0, height = 0;
  bool running = false, dirty = true, rough = false;  ///< rough: the last frame was drawn at moving quality
  Dragging dragging = Dragging::nothing;
  int drag_button = 0;
  glm::dvec2 last_px{0.0};
  Grab grab;
  glm::dvec3 grab_start{0.0};
  Clock::time_point last_movement{};
  FrameTimes times;
  std::vector<std::pair<Clock::time_point, double>> recent;  ///< of the drag under way: when, busy seconds
  double client_s = 0;  ///< of the frame that is being made

  explicit Impl(const EditWindowOptions& o);
  double unit() const { return std::clamp(height / 800.0, 0.85, 2.5); }
  Box box() const;
  ScreenMap screen() const;
  void aim();
  void draw(bool moving);
  void show_bar();
  void moved() {
    dirty = true;
    last_movement = Clock::now();
  }
  std::optional<glm::dvec3> on_grab_plane(const glm::dvec2& px) const;
  void handle(const XInput& in, EditWindowClient& client);
  void press(const XInput& in, EditWindowClient& client);
  void motion(const XInput& in, EditWindowClient& client);
};

EditWindow::Impl::Impl(const EditWindowOptions& o) : options(o), width(o.width_px), height(o.height_px) {
  check(o);
  if (!x_display_can_render())
    throw IoFailure(
        "the editor needs a display: no X server answers at DISPLAY, or it has no OpenGL. On a machine without a "
        "screen: xvfb-run -a -s \"-screen 0 1400x900x24 -noreset\" witherfield edit LEAF.toml");
  window->SetNumberOfLayers(3);
  window->SetMultiSamples(o.samples);
  window->SetSize(width, height);
  window->SetWindowName("witherfield edit");
  int layer = 0;
  for (vtkRenderer* r : {back.Get(), front.Get(), side.Get()}) {
    r->SetLayer(layer++);
    r->InteractiveOff();
    r->AutomaticLightCreationOff();
    window->AddRenderer(r);
  }
  back->SetActiveCamera(camera);
  front->SetActiveCamera(camera);
  back->GradientBackgroundOn();
  back->SetBackground(0.830, 0.855, 0.865);
  back->SetBackground2(0.975, 0.982, 0.985);
  // Surfaces light themselves, but only where there is a light do they get their normals.
  vtkNew<vtkLight> light;
  light->SetLightTypeToHeadlight();
  back->AddLight(light);
  beside = std::make_unique<EditSurface>(*back);
  surface = std::make_unique<EditSurface>(*back);
  markers = std::make_unique<EditMarkers>(*front);
  panels = std::make_unique<EditPanels>(*front);
}

Box EditWindow::Impl::box() const {
  Box b;
  for (const glm::dvec3& p : surface->positions()) b.add(p);
  for (const Marker& m : markers->markers()) b.add(m.position_m);
  if (b.empty) b.add({0, 0, 0}), b.add({0.1, 0.1, 0.1});
  return b;
}

ScreenMap EditWindow::Impl::screen() const {
  double range[2];
  camera->GetClippingRange(range);
  return eye.screen_map(width, height, range[0], range[1]);
}

/// The eye -> VTK's camera.
void EditWindow::Impl::aim() {
  const glm::dvec3 from = eye.eye_m(), up = eye.up();
  camera->SetPosition(from.x, from.y, from.z);
  camera->SetFocalPoint(eye.focus_m.x, eye.focus_m.y, eye.focus_m.z);
  camera->SetViewUp(up.x, up.y, up.z);
  camera->SetViewAngle(eye.view_angle_deg);
  camera->SetParallelProjection(eye.flat);
  camera->SetParallelScale(eye.reach_m);
  Box b = box();
  for (const glm::dvec3& p : beside->positions()) b.add(p);
  const double middle = glm::dot(b.middle() - from, glm::normalize(eye.focus_m - from)), radius = 1.05 * b.radius();
  const double far = std::max(middle + radius, 1e-3);
  camera->SetClippingRange(std::max(middle - radius, 1e-3 * far), far);
}

void EditWindow::Impl::show_bar() {
  side->RemoveAllViewProps();
  if (!bar) return;
  const Layout layout(width, height);
  side->SetViewport(1 - double(layout.legend_px) / width, 0, 1, 1);
  add_colour_bar(*side, layout, bar->map, bar->title, bar->unit);
}

void EditWindow::Impl::draw(bool moving) {
  const auto start = Clock::now();
  aim();
  markers->fit(screen(), unit());
  panels->lay_out(width, height, unit());
  if (bar_is_new) show_bar();
  bar_is_new = false;
  window->SetMultiSamples(moving ? options.moving_samples : options.samples);
  window->Render();
  rough = moving && options.moving_samples != options.samples;
  dirty = false;
  const auto now = Clock::now();
  if (dragging == Dragging::client) {
    const double draw_s = seconds(now - start);
    ++times.frames;
    times.client_s += client_s;
    times.draw_s += draw_s;
    times.slowest_s = std::max(times.slowest_s, client_s + draw_s);
    recent.emplace_back(now, client_s + draw_s);
    while (seconds(now - recent.front().first) > kRecent_s) recent.erase(recent.begin());
  }
  client_s = 0;
}

std::optional<glm::dvec3> EditWindow::Impl::on_grab_plane(const glm::dvec2& px) const {
  const glm::dvec3 across = glm::normalize(eye.eye_m() - eye.focus_m);
  return meet_plane(screen().ray(px.x, px.y), grab.anchor_m, grab.normal.value_or(across));
}

void EditWindow::Impl::press(const XInput& in, EditWindowClient& client) {
  if (dragging != Dragging::nothing) return;  // a second button while one is down
  last_px = {in.x, in.y};
  drag_button = in.button;
  if (in.button == 2 || (in.button != 1 && in.shift)) {
    dragging = Dragging::shifting;
    return;
  }
  dragging = Dragging::turning;
  if (in.button != 1) return;
  Press p;
  p.shift = in.shift;
  p.control = in.control;
  const ScreenMap map = screen();
  p.marker = marker_at(markers->markers(), map, in.x, in.y, kReach_px * unit());
  if (const auto hit = first_hit(map.ray(in.x, in.y), surface->positions(), surface->triangles())) {
    p.vertex = hit->vertex;
    p.point_m = hit->point_m;
  }
  p.ground_m = meet_plane(map.ray(in.x, in.y), glm::dvec3(0.0), glm::dvec3(0, 0, 1));
  p.metres_per_px = map.metres_per_pixel(p.vertex >= 0 ? p.point_m : p.ground_m.value_or(eye.focus_m));
  grab = client.press(p);
  if (!grab.taken) return;
  const auto start = on_grab_plane(last_px);
  if (!start) return;
  grab_start = *start;
  dragging = Dragging::client;
  recent.clear();
  moved();
}

void EditWindow::Impl::motion(const XInput& in, EditWindowClient& client) {
  const glm::dvec2 now(in.x, in.y), by = now - last_px;
  if (dragging == Dragging::nothing || (by.x == 0 && by.y == 0)) return;
  if (dragging == Dragging::client) {
    if (const auto at = on_grab_plane(now)) {
      const auto start = Clock::now();
      client.drag(grab.anchor_m + (*at - grab_start));
      client_s += seconds(Clock::now() - start);
    }
  }
  if (dragging == Dragging::turning && !eye.flat) eye.turn(by.x, by.y);
  if (dragging == Dragging::shifting || (dragging == Dragging::turning && eye.flat)) eye.shift(by.x, by.y, height);
  last_px = now;
  moved();
}

void EditWindow::Impl::handle(const XInput& in, EditWindowClient& client) {
  switch (in.kind) {
    case XInput::Kind::press:
      return press(in, client);
    case XInput::Kind::motion:
      return motion(in, client);
    case XInput::Kind::release:
      if (in.button != drag_button) return;
      motion(in, client);
      if (dragging == Dragging::client) client.release();
      dragging = Dragging::nothing;
      drag_button = 0;
      dirty = true;
      last_movement = {};  // the still picture at once
      return;
    case XInput::Kind::wheel: {
      const ScreenMap map = screen();
      const auto at = meet_plane(map.ray(in.x, in.y), eye.focus_m, glm::normalize(eye.eye_m() - eye.focus_m));
      eye.zoom(in.button > 0 ? 1 / 1.12 : 1.12, at.value_or(eye.focus_m));
      return moved();
    }
    case XInput::Kind::key:
      client.key({in.key, in.shift, in.control});
      dirty = true;
      return;
    case XInput::Kind::resized:
      if (in.x == width && in.y == height) return;
      width = in.x;
      height = in.y;
      window->SetSize(width, height);
      bar_is_new = bar.has_value();
      return moved();
    case XInput::Kind::exposed:
      dirty = true;
      return;
    case XInput::Kind::close:
      if (client.close()) running = false;
      return;
  }
}

EditWindow::EditWindow(const EditWindowOptions& options) : impl_(std::make_unique<Impl>(options)) {}

EditWindow::~EditWindow() { impl_->window->Finalize(); }

void EditWindow::show_surface(const Surface& surface, const SurfacePicture& picture) {
  surface.validate();
  impl_->surface->show(surface, picture);
  colour_by_surface();
}

void EditWindow::move_surface(std::span<const glm::dvec3> position) {
  impl_->surface->move(position);
  impl_->dirty = true;
}

void EditWindow::show_beside(const Surface& surface) {
  impl_->beside->show(surface, {});
  impl_->dirty = true;
}

void EditWindow::set_style(SurfaceStyle style) {
  impl_->surface->set_style(style);
  impl_->dirty = true;
}

void EditWindow::colour_by(std::span<const float> values, const ColourMap& map, const std::string& title,
                           const std::string& unit) {
  impl_->surface->colour_by(values, map);
  const auto& old = impl_->bar;
  if (!old || old->map.lo != map.lo || old->map.hi != map.hi || old->title != title) {
    impl_->bar = Bar{map, title, unit};
    impl_->bar_is_new = true;
  }
  impl_->dirty = true;
}

void EditWindow::colour_by_surface() {
  impl_->surface->colour_by_itself();
  impl_->bar_is_new = impl_->bar.has_value();
  impl_->bar.reset();
  impl_->dirty = true;
}

void EditWindow::set_markers(std::vector<Marker> markers) {
  impl_->markers->set_markers(std::move(markers));
  impl_->dirty = true;
}

void EditWindow::set_lines(const std::vector<MarkerLine>& lines) {
  impl_->markers->set_lines(lines);
  impl_->dirty = true;
}

void EditWindow::set_title(const std::string& title) { impl_->window->SetWindowName(title.c_str()); }

void EditWindow::set_panel(const std::string& heading, const PanelRows& rows) {
  impl_->panels->set_panel(heading, rows);
  impl_->dirty = true;
}

void EditWindow::set_hint(const std::string& hint) {
  impl_->panels->set_hint(hint);
  impl_->dirty = true;
}

void EditWindow::set_notice(const std::string& text, bool is_warning) {
  impl_->panels->set_notice(text, is_warning);
  impl_->dirty = true;
}

void EditWindow::set_help(const std::string& heading, const PanelRows& rows) {
  impl_->panels->set_help(heading, rows);
  impl_->dirty = true;
}

void EditWindow::look_from(double azimuth_deg, double elevation_deg) {
  const Box b = impl_->box();
  impl_->eye = {};
  impl_->eye.azimuth_deg = azimuth_deg;
  impl_->eye.elevation_deg = elevation_deg;
  impl_->eye.focus_m = b.middle();
  impl_->eye.reach_m = 0.70 * b.radius();
  impl_->dirty = true;
}

void EditWindow::look_down() {
  const Box b = impl_->box();
  impl_->eye = {};
  impl_->eye.flat = true;
  impl_->eye.focus_m = b.middle();
  const glm::dvec3 half = 0.5 * (b.hi - b.lo);
  impl_->eye.reach_m = 1.22 * std::max(half.x, half.y * impl_->height / impl_->width);
  impl_->dirty = true;
}

void EditWindow::run(EditWindowClient& client) {
  Impl& m = *impl_;
  const VtkMessages messages;
  m.draw(false);
  if (messages.has_error()) throw IoFailure("cannot draw the editor's window: " + messages.first_error());
  void* display = m.window->GetGenericDisplayId();
  m.events = std::make_unique<XEvents>(display, reinterpret_cast<unsigned long>(m.window->GetGenericWindowId()));
  m.running = m.dirty = true;
  while (m.running) {
    for (const XInput& in : m.events->fetch()) {
      m.handle(in, client);
      if (!m.running) return;
    }
    client.turn();
    const bool moving = m.dragging == Impl::Dragging::client || seconds(Clock::now() - m.last_movement) < kSettle_s;
    if (m.dirty || (m.rough && !moving))
      m.draw(moving);
    else
      m.events->wait(kTurn_s);
  }
}

void EditWindow::quit() { impl_->running = false; }

SurfacePicture EditWindow::picture() {
  Impl& m = *impl_;
  m.draw(false);
  vtkNew<vtkUnsignedCharArray> pixels;
  m.window->GetPixelData(0, 0, m.width - 1, m.height - 1, 0, pixels);
  SurfacePicture out{m.width, m.height, {}};
  const std::size_t row = 3 * std::size_t(m.width);
  for (int y = m.height - 1; y >= 0; --y)
    out.rgb.insert(out.rgb.end(), pixels->GetPointer(vtkIdType(row) * y), pixels->GetPointer(vtkIdType(row) * y) + row);
  return out;
}

const FrameTimes& EditWindow::frame_times() const { return impl_->times; }

double EditWindow::frames_per_second() const {
  double busy = 0;
  for (const auto& frame : impl_->recent) busy += frame.second;
  return busy > 0 ? double(impl_->recent.size()) / busy : 0;
}

}  // namespace witherfield::vis
