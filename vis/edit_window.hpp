// An interactive window on an X display: a surface with markers that the mouse can take and drag, lines, text panels
// and a colour bar. It knows nothing of what is edited: a client answers presses, drags and keys, and tells the window
// what to show.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/surface.hpp"
#include "vis/colour_map.hpp"

namespace witherfield::vis {

struct EditWindowOptions {
  int width_px = 1280, height_px = 800;  ///< 480..8192 x 360..8192
  int samples = 8;                       ///< of multi-sample anti-aliasing while nothing moves, 0..16
  int moving_samples = 0;                ///< the same while something is dragged, 0..16
};

/// A picture that is laid over a surface's uv. Encoded sRGB, rows from v = 0 upwards, u = 0 on the left.
struct SurfacePicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

enum class SurfaceStyle { smooth, edges, wireframe };

enum class MarkerLook {
  handle,   ///< orange ball
  pin,      ///< blue ball: a handle that is there to hold
  outline,  ///< green ball
  midrib,   ///< violet ball
  dot       ///< small and faint, cannot be taken
};
struct Marker {
  glm::dvec3 position_m{0.0};
  MarkerLook look = MarkerLook::handle;
  bool selected = false;
};
struct MarkerLine {
  std::vector<glm::dvec3> points_m;
  MarkerLook look = MarkerLook::outline;
};

/// The left button went down.
struct Press {
  int marker = -1;          ///< the nearest one within reach, -1 = none
  int vertex = -1;          ///< nearest corner of the triangle under the pointer, -1 = beside the surface
  glm::dvec3 point_m{0.0};  ///< where the surface is hit
  std::optional<glm::dvec3> ground_m;  ///< where the line of sight meets z = 0
  double metres_per_px = 0;            ///< there, or at the surface
  bool shift = false, control = false;
};

/// What the client makes of a press. When it takes it, drags follow until the button goes up; else the view turns.
struct Grab {
  bool taken = false;
  glm::dvec3 anchor_m{0.0};           ///< drags say where this point goes to
  std::optional<glm::dvec3> normal;   ///< of the plane in which it moves; none: across the line of sight
};

struct KeyPress {
  std::string name;  ///< X's name: "z", "Delete", "F1", "bracketleft"; letters always small
  bool shift = false, control = false;
};

/// Called by run(), never from within one of the library's callbacks: it may throw, and run() passes it on.
class EditWindowClient {
 public:
  virtual ~EditWindowClient() = default;
  virtual Grab press(const Press&) = 0;
  virtual void drag(const glm::dvec3& anchor_to_m) = 0;  ///< once a frame at most: the last place counts
  virtual void release() = 0;
  virtual void key(const KeyPress&) = 0;
  virtual void turn() = 0;   ///< each turn of the loop, at least 20 times a second
  virtual bool close() = 0;  ///< the window shall close; false keeps it open
};

/// Of the frames drawn while something was dragged.
struct FrameTimes {
  int frames = 0;
  double client_s = 0;   ///< in the client: solving
  double draw_s = 0;     ///< upload, raster and swap
  double slowest_s = 0;  ///< longest frame
  /// Waiting for the mouse is left out.
  double per_second() const { return frames > 0 ? frames / (client_s + draw_s) : 0; }
};

class EditWindow {
 public:
  /// @throws IoFailure when no X display answers or it cannot draw; InvalidInput on sizes out of range.
  explicit EditWindow(const EditWindowOptions& options);
  ~EditWindow();
  EditWindow(const EditWindow&) = delete;
  EditWindow& operator=(const EditWindow&) = delete;

  /// Another surface. `picture` (may be empty) needs uv; without it the field `diffuse` colours the vertices.
  void show_surface(const Surface& surface, const SurfacePicture& picture);
  /// The same triangles elsewhere. @throws InvalidInput on a wrong count.
  void move_surface(std::span<const glm::dvec3> position_m);
  /// Something that is shown beside it and cannot be picked; empty = nothing.
  void show_beside(const Surface& surface);
  void set_style(SurfaceStyle style);

  /// Values of the vertices through a map, with a colour bar; instead of the surface's own colours.
  void colour_by(std::span<const float> values, const ColourMap& map, const std::string& title,
                 const std::string& unit);
  void colour_by_surface();

  void set_markers(std::vector<Marker> markers);
  void set_lines(const std::vector<MarkerLine>& lines);

  void set_title(const std::string& title);  ///< of the window's frame
  /// The panel in the upper left corner: a heading, and rows of name and value.
  void set_panel(const std::string& heading, const std::vector<std::pair<std::string, std::string>>& rows);
  void set_hint(const std::string& hint);    ///< one line at the bottom
  void set_notice(const std::string& text, bool is_warning = false);  ///< over the hint; "" = none
  /// Keys and what they do, in the middle of the window; empty = no help is shown.
  void set_help(const std::string& heading, const std::vector<std::pair<std::string, std::string>>& rows);

  /// The whole surface comes into view. Angles as of a box's picture: azimuth counter-clockwise from +x.
  void look_from(double azimuth_deg, double elevation_deg);
  /// From above (-z), without perspective; +x is up on the screen.
  void look_down();

  /// Until the client lets it close. @throws what the client throws.
  void run(EditWindowClient& client);
  void quit();  ///< ends run() after this turn

  /// What is on the screen, as encoded sRGB, rows from the top.
  SurfacePicture picture();
  const FrameTimes& frame_times() const;
  double frames_per_second() const;  ///< of the drag under way, or of the last one

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace witherfield::vis
