// The surface of an edit window as VTK draws it: its points are replaced in place while it moves.
#pragma once
#include <memory>
#include <span>

#include "vis/edit_window.hpp"

class vtkRenderer;

namespace witherfield::vis {

class EditSurface {
 public:
  explicit EditSurface(vtkRenderer& renderer);
  ~EditSurface();
  EditSurface(const EditSurface&) = delete;
  EditSurface& operator=(const EditSurface&) = delete;

  void show(const Surface& surface, const SurfacePicture& picture);
  void move(std::span<const glm::dvec3> position_m);
  void set_style(SurfaceStyle style);
  void colour_by(std::span<const float> values, const ColourMap& map);
  void colour_by_itself();

  const std::vector<glm::dvec3>& positions() const;
  const std::vector<std::array<int, 3>>& triangles() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace witherfield::vis
