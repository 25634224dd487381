// Markers and lines over the surface of an edit window: always in front, of the same size on the screen wherever they are.
#pragma once
#include <glm/mat4x4.hpp>
#include <memory>
#include <vector>

#include "vis/edit_window.hpp"
#include "vis/ray_pick.hpp"

class vtkRenderer;

namespace witherfield::vis {

/// From the world to pixels from the upper left, and back.
struct ScreenMap {
  glm::dmat4 to_clip{1.0}, from_clip{1.0};
  int width_px = 1, height_px = 1;
  glm::dvec3 pixel(const glm::dvec3& world) const;  ///< z = depth, -1 near .. 1 far
  Ray ray(double x_px, double y_px) const;
  double metres_per_pixel(const glm::dvec3& at) const;
};

/// Number of the marker that the pointer can take, -1 = none. Nearest on the screen; dots are never taken.
int marker_at(const std::vector<Marker>& markers, const ScreenMap& map, double x_px, double y_px, double reach_px);

class EditMarkers {
 public:
  explicit EditMarkers(vtkRenderer& renderer);
  ~EditMarkers();
  EditMarkers(const EditMarkers&) = delete;
  EditMarkers& operator=(const EditMarkers&) = delete;

  void set_markers(std::vector<Marker> markers);
  void set_lines(const std::vector<MarkerLine>& lines);
  /// Before each frame: their size in the world. @param unit 1 = a screen of ordinary resolution.
  void fit(const ScreenMap& map, double unit);
  const std::vector<Marker>& markers() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace witherfield::vis
