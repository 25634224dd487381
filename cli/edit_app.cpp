#include "cli/edit_app.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <future>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <sstream>

#include "cli/edit_save.hpp"
#include "cli/edit_session.hpp"
#include "cli/edit_texts.hpp"
#include "cli/leaf_input.hpp"
#include "pov/png.hpp"
#include "sim/check/mesh_check.hpp"
#include "sim/core/colour.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"
#include "sim/leaf/leaf_colour.hpp"

namespace witherfield::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using vis::MarkerLook;

constexpr int kPicturePixels = 1024;      // of the veins over the leaf
constexpr double kCurveReach_px = 12;     // a click this near to a curve makes a point on it
constexpr double kNotice_s = 6;
constexpr double kSolve_s = 0.0055;       // of a frame for solving, if it can be had
constexpr double kPanel_s = 0.25;         // between two refreshes of the panel while dragging, at least;
constexpr double kPanelShare = 25;        // and so many times what one takes
constexpr const char* kFields[] = {"", "strain_area", "displacement_m", "vein"};
constexpr int kFieldCount = 4;

std::string text_of_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw IoFailure("cannot read '" + file.string() + "'");
  return text.str();
}

/// The upper side with its veins, finer than the mesh; empty for leaves without veins.
vis::SurfacePicture leaf_picture(const leaf::LeafModel& model) {
  if (model.veins.empty()) return {};
  const leaf::VeinMap map = leaf::rasterize_veins(model, kPicturePixels);
  vis::SurfacePicture picture{map.pixels, map.pixels, std::vector<std::uint8_t>(map.vein.size() * 3)};
  const glm::dvec3 blade = leaf::leaf_colour(model.chlorophyll_ug_cm2, 1),
                   pale = leaf::leaf_colour(0.16 * model.chlorophyll_ug_cm2, 1);
  for (std::size_t i = 0; i < map.vein.size(); ++i) {
    // Between the veins the blade bulges: a little lighter in the middle of each cell. Exposed for a screen: a leaf reflects
    // only a few percent.
    const glm::dvec3 c = 1.7 * (0.80 + 0.28 * double(map.height[i])) * glm::mix(blade, pale, 0.75 * double(map.vein[i]));
    const glm::dvec3 levels = srgb_levels(c);
    for (int k = 0; k < 3; ++k) picture.rgb[3 * i + std::size_t(k)] = std::uint8_t(std::lround(levels[k]));
  }
  return picture;
}

/// 1, 2 or 5 times a power of ten, at least `value`.
double round_up(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * decade >= value * (1 - 1e-9)) return step * decade;
  return 10 * decade;
}

class EditApp : public vis::EditWindowClient {
 public:
  EditApp(const EditRequest& request, Console& console)
      : request_(request), console_(console), toml_(text_of_file(request.scene_file)),
        scene_(scene::load_leaf_scene(request.scene_file.string())), window_(request.window),
        session_(scene_, read_leaf_input(scene_)) {}

  void open() {
    show_leaf();
    window_.look_from(-58, 38);
    window_.set_hint(hint_text(tool_));
    count_intersections();
    refresh();
    window_.run(*this);
    say_frame_times();
  }

  vis::Grab press(const vis::Press& p) override {
    vis::Grab grab;
    guarded([&] { grab = tool_ == EditTool::handles ? press_handle(p) : press_point(p); });
    if (!grab.taken && session_.in_gesture()) session_.end();
    refresh();
    return grab;
  }

  void drag(const glm::dvec3& to_m) override {
    guarded([&] {
      if (tool_ == EditTool::handles) {
        const auto start = Clock::now();
        session_.move_handle(handle_, to_m, iterations_);
        // As many iterations as leave time for drawing; the next frame goes on from here.
        const double taken_s = std::chrono::duration<double>(Clock::now() - start).count();
        if (!first_move_) iterations_ = std::clamp(taken_s > kSolve_s ? iterations_ - 1 : iterations_ + 1, 1, 6);
        first_move_ = false;
        window_.move_surface(session_.positions());
        if (field_ != 0) show_field();
      } else {
        session_.move_point(point_, to_m);
        window_.show_surface(session_.flat_leaf(), {});
        sketched_ = true;
      }
    });
    show_markers();
    if (Clock::now() - panel_time_ > std::chrono::duration<double>(std::max(kPanel_s, kPanelShare * panel_cost_s_))) show_panel();
  }

  void release() override {
    guarded([&] { session_.end(); });
    after_edit();
  }

  void key(const vis::KeyPress& k) override {
    guarded([&] { command(k); });
    refresh();
  }

  void turn() override {
    check_interrupted();
    const auto now = Clock::now();
    if (!notice_.empty() && now > notice_until_) {
      notice_.clear();
      window_.set_notice("");
    }
    if (counting_.valid() && counting_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
      intersections_ = counting_.get();
      if (count_again_) count_intersections();
      refresh();
    }
  }

  bool close() override {
    if (!session_.changed() || quit_asked_) return true;
    quit_asked_ = true;
    notice("Not saved. S saves; Q or closing again leaves without saving.", true);
    return false;
  }

 private:
  // ---- presses

  vis::Grab press_handle(const vis::Press& p) {
    handle_ = p.marker;
    if (p.marker < 0 && p.vertex < 0) return {};
    session_.begin();
    first_move_ = true;
    if (p.marker < 0) handle_ = session_.add_handle(p.vertex);
    return {true, session_.handle_place(handle_), std::nullopt};
  }

  vis::Grab press_point(const vis::Press& p) {
    has_point_ = p.marker >= 0;
    if (p.marker >= 0) {
      point_ = marker_points_[std::size_t(p.marker)];
    } else if (p.ground_m && distance_to_curves(*p.ground_m) < kCurveReach_px * p.metres_per_px) {
      session_.begin();
      point_ = session_.add_point(*p.ground_m);
      has_point_ = true;
    } else {
      return {};
    }
    if (!session_.in_gesture()) session_.begin();
    return {true, session_.place(point_), glm::dvec3(0, 0, 1)};
  }

  double distance_to_curves(const glm::dvec3& at) const {
    double least = 1e9;
    for (const auto& curve : session_.curves())
      for (std::size_t k = 0; k + 1 < curve.size(); ++k) {
        const glm::dvec3 along = curve[k + 1] - curve[k];
        const double square = glm::dot(along, along), t = square > 0 ? std::clamp(glm::dot(at - curve[k], along) / square, 0.0, 1.0) : 0;
        least = std::min(least, glm::distance(at, curve[k] + t * along));
      }
    return least;
  }

  // ---- keys

  void command(const vis::KeyPress& k) {
    if (k.name != "q" && k.name.find("Shift") == std::string::npos && k.name.find("Control") == std::string::npos)
      quit_asked_ = false;
    if (k.control) {
      if (k.name == "z") return k.shift ? redo() : undo();
      if (k.name == "y") return redo();
      if (k.name == "s") return save();
      if (k.name == "q") return quit();
      return;
    }
    if (k.name == "h" || k.name == "F1") return toggle_help();
    if (k.name == "Escape") return escape();
    if (k.name == "Tab") return set_tool(tool_ == EditTool::handles ? EditTool::outline : EditTool::handles);
    if (k.name == "s") return save();
    if (k.name == "q") return quit();
    if (k.name == "u") return k.shift ? redo() : undo();
    if (k.name == "r") return reset();
    if (k.name == "m") return toggle_mode();
    if (k.name == "w") return next_style();
    if (k.name == "f") return next_field(k.shift ? kFieldCount - 1 : 1);
    if (k.name == "v") return next_view();
    if (k.name == "c" || k.name == "Home") return whole_leaf_in_view();
    if (k.name == "p") return save_picture();
    if (k.name == "Delete" || k.name == "BackSpace" || k.name == "x") return remove();
    if (k.name == "k") return add_key();
    if (k.name == "bracketleft") return grow_handle(-1);
    if (k.name == "bracketright") return grow_handle(1);
  }

  void quit() {
    if (close()) window_.quit();
  }
  void undo() {
    if (!session_.can_undo()) return notice("Nothing to undo.");
    session_.undo();
    after_jump();
  }
  void redo() {
    if (!session_.can_redo()) return notice("Nothing to redo.");
    session_.redo();
    after_jump();
  }
  void reset() {
    session_.reset();
    after_jump();
    notice("The leaf as it was opened. Ctrl+Z brings the edit back.");
  }
  void toggle_mode() {
    using leaf::EditMode;
    session_.set_mode(session_.edit().mode == EditMode::linear ? EditMode::rotation_aware : EditMode::linear);
    after_edit();
  }
  void remove() {
    if (tool_ == EditTool::handles) {
      if (handle_ < 0) return notice("Select a handle first: click it.");
      session_.remove_handle(handle_);
      handle_ = -1;
    } else {
      if (!has_point_) return notice("Select a point first: click it.");
      session_.remove_point(point_);
      has_point_ = false;
    }
    after_edit();
  }
  void add_key() {
    session_.add_key();
    notice(fmt::format("Key frame {} is kept; the handles now move key frame {}.", session_.edit().keys.size() - 1,
                       session_.edit().keys.size()));
  }
  void grow_handle(int direction) {
    if (tool_ != EditTool::handles || handle_ < 0) return notice("Select a handle first: click it.");
    const double step = 0.012 * std::max(session_.model().main_vein_m, 0.02);
    session_.set_radius(handle_, session_.edit().handles[std::size_t(handle_)].radius_m + direction * step);
    after_edit();
  }
  void next_style() {
    using vis::SurfaceStyle;
    style_ = style_ == SurfaceStyle::smooth ? SurfaceStyle::edges
             : style_ == SurfaceStyle::edges ? SurfaceStyle::wireframe
                                             : SurfaceStyle::smooth;
    window_.set_style(style_);
  }
  void next_field(int by) {
    if (tool_ != EditTool::handles) return notice("Fields are shown on the edited leaf: Tab goes there.");
    field_ = (field_ + by) % kFieldCount;
    show_field();
  }
  void next_view() {
    if (tool_ == EditTool::outline) return;
    static constexpr double kViews[][2] = {{-58, 38}, {-90, 89.9}, {-90, 4}, {0, 4}, {122, -30}};
    view_ = (view_ + 1) % 5;
    window_.look_from(kViews[view_][0], kViews[view_][1]);
  }
  void whole_leaf_in_view() {
    if (tool_ == EditTool::outline) return window_.look_down();
    view_ = -1;
    next_view();
  }
  void toggle_help() {
    help_ = !help_;
    if (help_)
      window_.set_help("Shaping a leaf", help_rows());
    else
      window_.set_help("", {});
  }
  void escape() {
    if (help_) return toggle_help();
    handle_ = -1;
    has_point_ = false;
  }
  void set_tool(EditTool tool) {
    if (tool == EditTool::outline && !session_.has_outline())
      throw InvalidInput("This leaf was read from a mesh: it has no outline points.");
    tool_ = tool;
    shown_ = nullptr;
    show_leaf();
    whole_leaf_in_view();
    window_.set_hint(hint_text(tool_));
  }
  void save() {
    const auto files = save_edit(session_, scene_, request_.scene_file, toml_, request_.target);
    session_.mark_saved();
    std::string names;
    for (const fs::path& f : files) {
      names += (names.empty() ? "" : ", ") + f.filename().string();
      console_.say(f.string());
    }
    notice("Saved " + names);
  }
  void save_picture() {
    fs::path file = request_.target;
    file.replace_extension(".png");
    window_.set_notice("");
    notice_.clear();
    refresh();
    const vis::SurfacePicture p = window_.picture();
    pov::write_png(file, p.width, p.height, p.rgb);
    console_.say(file.string());
    notice("Saved " + file.filename().string());
  }

  // ---- what is shown

  void after_edit() {
    count_intersections();
    refresh();
  }
  void after_jump() {
    const int handles = int(session_.edit().handles.size());
    if (handle_ >= handles) handle_ = -1;
    has_point_ = false;
    after_edit();
  }

  void refresh() {
    show_leaf();
    show_markers();
    show_panel();
  }

  /// The whole surface where the mesh is another one, else its points only.
  void show_leaf() {
    const leaf::LeafModel* model = &session_.model();
    const bool other = model != shown_ || sketched_;
    if (model != pictured_) {
      picture_ = leaf_picture(*model);
      pictured_ = model;
    }
    if (tool_ == EditTool::outline) {
      if (!other) return;
      window_.show_surface(session_.flat_leaf(), picture_);
      window_.show_beside({});
    } else {
      report_ = session_.report();
      if (other) {
        window_.show_surface(leaf::to_surface(*model, session_.positions()), picture_);
        window_.show_beside(leaf::petiole_surface(model->petiole));
      } else {
        window_.move_surface(session_.positions());
      }
      show_field();
    }
    shown_ = model;
    sketched_ = false;
  }

  void show_field() {
    const std::string name = kFields[field_];
    if (name.empty()) return window_.colour_by_surface();
    const Surface s = leaf::to_surface(session_.model(), session_.positions());
    const auto& all = s.field(name).values;
    const FieldSpec& spec = field_spec(name);
    std::vector<float> values(s.position_m.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      double square = 0;
      for (int c = 0; c < spec.components; ++c) square += double(all[i * std::size_t(spec.components) + std::size_t(c)]) * double(all[i * std::size_t(spec.components) + std::size_t(c)]);
      values[i] = spec.components == 1 ? all[i] : float(std::sqrt(square) * 1e3);
    }
    // The scale of all but a hundredth of the vertices: those beside a handle would take it for themselves.
    std::vector<float> sizes(values);
    for (float& v : sizes) v = std::abs(v);
    const auto high = sizes.begin() + std::ptrdiff_t(0.99 * double(sizes.size() - 1));
    std::nth_element(sizes.begin(), high, sizes.end());
    const float largest = *high;
    const bool length = name == "displacement_m";
    double hi = name == "vein" ? 1.0 : round_up(std::max(double(largest), length ? 1.0 : 0.01));
    if (session_.in_gesture()) hi = std::max(hi, scale_);  // the scale does not jump while the mouse moves
    scale_ = hi;
    window_.colour_by(values, vis::colour_map(name, name == "strain_area" ? -hi : 0, hi), std::string(spec.title),
                      length ? "mm" : "");
  }

  void show_markers() {
    std::vector<vis::Marker> markers;
    marker_points_.clear();
    if (tool_ == EditTool::handles) {
      window_.set_lines({});
      const int count = int(session_.edit().handles.size());
      for (int i = 0; i < count; ++i)
        markers.push_back({session_.handle_place(i), session_.edit().handles[std::size_t(i)].name == "petiole" ? MarkerLook::pin : MarkerLook::handle, i == handle_});
      if (handle_ >= 0)
        for (const int v : session_.held_along(handle_)) markers.push_back({session_.positions()[std::size_t(v)], MarkerLook::dot, false});
    } else {
      const leaf::OutlinePoints& p = session_.points();
      for (const auto& [group, size] : {std::pair{OutlineGroup::left, p.left_m.size()}, {OutlineGroup::right, p.right_m.size()}, {OutlineGroup::midrib, p.midrib_m.size()}})
        for (int i = 0; i < int(size); ++i) {
          const OutlinePoint point{group, i};
          marker_points_.push_back(point);
          markers.push_back({session_.place(point), group == OutlineGroup::midrib ? MarkerLook::midrib : MarkerLook::outline, has_point_ && point == point_});
        }
      std::vector<vis::MarkerLine> lines;
      for (const auto& curve : session_.curves()) lines.push_back({curve, lines.size() == 2 ? MarkerLook::midrib : MarkerLook::outline});
      window_.set_lines(lines);
    }
    window_.set_markers(std::move(markers));
  }

  void show_panel() {
    const auto start = Clock::now();
    EditStatus s;
    s.name = scene_.name;
    s.tool = tool_;
    s.selected_handle = tool_ == EditTool::handles ? handle_ : -1;
    s.changed = session_.changed();
    if (session_.in_gesture() && tool_ == EditTool::handles) report_ = session_.report();
    s.report = report_;
    s.intersections = intersections_;
    s.frames_per_second = window_.frames_per_second();
    s.field = field_ == 0 ? "" : std::string(field_spec(kFields[field_]).title);
    window_.set_panel(panel_heading(session_, tool_), panel_rows(session_, s));
    if (!session_.in_gesture()) window_.set_title(title_text(session_, s));
    panel_time_ = Clock::now();
    panel_cost_s_ = std::chrono::duration<double>(panel_time_ - start).count();
  }

  void notice(const std::string& text, bool warning = false) {
    notice_ = text;
    notice_until_ = Clock::now() + std::chrono::milliseconds(int(kNotice_s * 1000));
    window_.set_notice(text, warning);
  }

  /// What the user cannot have is said in the window; the leaf stays as it was.
  template <class Action>
  void guarded(const Action& action) {
    try {
      action();
    } catch (const Error& e) {
      notice(e.what(), true);
    }
  }

  /// Beside the window's work: it takes longer than a frame.
  void count_intersections() {
    intersections_ = -1;
    count_again_ = counting_.valid();
    if (count_again_) return;
    Surface blade = session_.model().natural;
    blade.position_m = session_.positions();
    blade.normal.clear();
    counting_ = std::async(std::launch::async, [blade = std::move(blade)] {
      return long(check::check_mesh(to_tri_mesh(blade, true)).self_intersections);
    });
  }

  void say_frame_times() {
    const vis::FrameTimes& t = window_.frame_times();
    if (t.frames == 0) return;
    console_.note(fmt::format("{} frames while dragging {} vertices: {:.0f} frames/s (a frame: solving {:.1f} ms, drawing {:.1f} ms; slowest {:.0f} ms)",
                              t.frames, session_.positions().size(), t.per_second(), 1e3 * t.client_s / t.frames,
                              1e3 * t.draw_s / t.frames, 1e3 * t.slowest_s));
  }

  const EditRequest& request_;
  Console& console_;
  std::string toml_;
  scene::LeafScene scene_;
  vis::EditWindow window_;  // first: without a display there is no need to build the leaf
  EditSession session_;

  EditTool tool_ = EditTool::handles;
  int handle_ = -1;
  bool has_point_ = false;
  OutlinePoint point_;
  std::vector<OutlinePoint> marker_points_;
  vis::SurfaceStyle style_ = vis::SurfaceStyle::smooth;
  int field_ = 0, view_ = 0;
  double scale_ = 0;
  bool help_ = false, quit_asked_ = false, sketched_ = false;
  const leaf::LeafModel *shown_ = nullptr, *pictured_ = nullptr;
  vis::SurfacePicture picture_;
  leaf::EditReport report_;
  int iterations_ = 4;
  double panel_cost_s_ = 0;
  bool first_move_ = true;  ///< it sets the handles, which is no measure
  long intersections_ = -1;
  std::future<long> counting_;
  bool count_again_ = false;
  std::string notice_;
  Clock::time_point notice_until_{}, panel_time_{};
};

}  // namespace

void edit_leaf(const EditRequest& request, Console& console) {
  EditApp app(request, console);
  app.open();
}

}  // namespace witherfield::cli
