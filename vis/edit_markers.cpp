#include "vis/edit_markers.hpp"

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <numbers>

namespace witherfield::vis {
namespace {

struct Look {
  glm::dvec3 colour;
  double radius_px;
};

Look look_of(MarkerLook look) {
  switch (look) {
    case MarkerLook::handle: return {{0.93, 0.45, 0.08}, 7.5};
    case MarkerLook::pin: return {{0.16, 0.42, 0.80}, 7.5};
    case MarkerLook::outline: return {{0.05, 0.56, 0.40}, 6.0};
    case MarkerLook::midrib: return {{0.52, 0.30, 0.70}, 6.0};
    case MarkerLook::dot: return {{0.98, 0.72, 0.40}, 2.4};
  }
  return {};
}

/// Discs in pixels, one over the other in the order in which they are added.
class Discs {
 public:
  Discs() {
    colours_->SetNumberOfComponents(4);
    colours_->SetName("colour");
  }
  void add(const glm::dvec2& middle, double radius, const glm::dvec3& colour, double opacity) {
    constexpr int kCorners = 32;
    cells_->InsertNextCell(kCorners);
    for (int k = 0; k < kCorners; ++k) {
      const double a = 2 * std::numbers::pi * k / kCorners;
      cells_->InsertCellPoint(points_->InsertNextPoint(middle.x + radius * std::cos(a), middle.y + radius * std::sin(a), 0));
    }
    unsigned char rgba[4];
    for (int c = 0; c < 3; ++c) rgba[c] = static_cast<unsigned char>(std::lround(std::clamp(colour[c], 0.0, 1.0) * 255));
    rgba[3] = static_cast<unsigned char>(std::lround(opacity * 255));
    colours_->InsertNextTypedTuple(rgba);
  }
  bool empty() const { return points_->GetNumberOfPoints() == 0; }
  void give_to(vtkPolyData& data) const {
    data.SetPoints(points_);
    data.SetPolys(cells_);
    data.GetCellData()->SetScalars(colours_);
  }

 private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> cells_;
  vtkNew<vtkUnsignedCharArray> colours_;
};

}  // namespace

glm::dvec3 ScreenMap::pixel(const glm::dvec3& world) const {
  const glm::dvec4 c = to_clip * glm::dvec4(world, 1.0);
  const glm::dvec3 n = glm::dvec3(c) / c.w;
  return {0.5 * (n.x + 1) * width_px, 0.5 * (1 - n.y) * height_px, n.z};
}

Ray ScreenMap::ray(double x, double y) const {
  const auto at = [&](double depth) {
    const glm::dvec4 p = from_clip * glm::dvec4(2 * x / width_px - 1, 1 - 2 * y / height_px, depth, 1.0);
    return glm::dvec3(p) / p.w;
  };
  const glm::dvec3 near = at(-1);
  return {near, glm::normalize(at(1) - near)};
}

double ScreenMap::metres_per_pixel(const glm::dvec3& at) const {
  const glm::dvec3 p = pixel(at);
  const glm::dvec4 q = from_clip * glm::dvec4(2 * (p.x + 1) / width_px - 1, 1 - 2 * p.y / height_px, p.z, 1.0);
  return glm::distance(glm::dvec3(q) / q.w, at);
}

int marker_at(const std::vector<Marker>& markers, const ScreenMap& map, double x, double y, double reach_px) {
  int best = -1;
  double nearest = reach_px;
  for (std::size_t i = 0; i < markers.size(); ++i) {
    if (markers[i].look == MarkerLook::dot) continue;
    const glm::dvec3 p = map.pixel(markers[i].position_m);
    const double distance = glm::length(glm::dvec2(p.x - x, p.y - y));
    if (distance > nearest || p.z < -1 || p.z > 1) continue;
    nearest = distance;
    best = int(i);
  }
  return best;
}

struct EditMarkers::Impl {
  std::vector<Marker> markers;
  vtkNew<vtkPolyData> discs, lines;
  vtkNew<vtkPolyDataMapper2D> disc_mapper;
  vtkNew<vtkPolyDataMapper> line_mapper;
  vtkNew<vtkActor2D> disc_actor;
  vtkNew<vtkActor> line_actor;
};

EditMarkers::EditMarkers(vtkRenderer& renderer) : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  m.disc_mapper->SetInputData(m.discs);
  m.disc_mapper->SetScalarModeToUseCellData();
  m.disc_actor->SetMapper(m.disc_mapper);
  m.line_mapper->SetInputData(m.lines);
  m.line_actor->SetMapper(m.line_mapper);
  m.line_actor->GetProperty()->LightingOff();
  m.line_actor->GetProperty()->SetLineWidth(2);
  renderer.AddActor(m.line_actor);
  renderer.AddActor2D(m.disc_actor);
  set_markers({});
  set_lines({});
}

EditMarkers::~EditMarkers() = default;

const std::vector<Marker>& EditMarkers::markers() const { return impl_->markers; }

void EditMarkers::set_markers(std::vector<Marker> markers) { impl_->markers = std::move(markers); }

void EditMarkers::set_lines(const std::vector<MarkerLine>& lines) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (const MarkerLine& line : lines) {
    if (line.points_m.size() < 2) continue;
    cells->InsertNextCell(static_cast<int>(line.points_m.size()));
    for (const glm::dvec3& p : line.points_m) cells->InsertCellPoint(points->InsertNextPoint(p.x, p.y, p.z));
    const glm::dvec3 c = 255.0 * look_of(line.look).colour;
    colours->InsertNextTuple3(c.r, c.g, c.b);
  }
  Impl& m = *impl_;
  m.line_actor->SetVisibility(points->GetNumberOfPoints() > 0);
  m.lines->SetPoints(points);
  m.lines->SetLines(cells);
  m.lines->GetCellData()->SetScalars(colours);
}

void EditMarkers::fit(const ScreenMap& map, double unit) {
  Impl& m = *impl_;
  Discs discs;
  for (const Marker& marker : m.markers) {
    const Look look = look_of(marker.look);
    const glm::dvec3 px = map.pixel(marker.position_m);
    if (px.z < -1 || px.z > 1) continue;
    const glm::dvec2 at(px.x, map.height_px - px.y);
    const double r = look.radius_px * (marker.selected ? 1.25 : 1.0) * unit;
    if (marker.look == MarkerLook::dot) {
      discs.add(at, r, look.colour, 1);
      continue;
    }
    // A shadow and a light rim, so that it is seen on any ground; a ball that is lit from the upper left.
    discs.add(at, r + (marker.selected ? 5.5 : 3.4) * unit, {0.10, 0.12, 0.14}, marker.selected ? 0.9 : 0.35);
    discs.add(at, r + (marker.selected ? 3.2 : 2.0) * unit, {1, 1, 1}, 1);
    discs.add(at, r, 0.82 * look.colour, 1);
    discs.add(at + glm::dvec2(-0.10, 0.10) * r, 0.82 * r, look.colour, 1);
    discs.add(at + glm::dvec2(-0.28, 0.28) * r, 0.36 * r, glm::mix(look.colour, glm::dvec3(1.0), 0.45), 0.9);
  }
  m.disc_actor->SetVisibility(!discs.empty());
  discs.give_to(*m.discs);
}

}  // namespace witherfield::vis
