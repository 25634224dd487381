#include "vis/edit_markers.hpp"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace witherfield::vis {
namespace {

struct Look {
  std::array<unsigned char, 3> colour;
  double radius_px;
};

Look look_of(MarkerLook look) {
  switch (look) {
    case MarkerLook::handle: return {{238, 118, 28}, 7.5};
    case MarkerLook::pin: return {{44, 110, 200}, 7.5};
    case MarkerLook::outline: return {{24, 140, 96}, 6.0};
    case MarkerLook::midrib: return {{132, 76, 176}, 6.0};
    case MarkerLook::dot: return {{238, 150, 70}, 2.6};
  }
  return {};
}

// A ball lit from the upper left with a soft rim; what it is drawn on stays visible around it.
constexpr const char* kBall =
    "//VTK::Color::Impl\n"
    "float r = length(offsetVCVSOutput.xy);\n"
    "if (r > 1.0) { discard; }\n"
    "float lit = 0.78 + 0.30 * dot(vec3(offsetVCVSOutput.xy, sqrt(max(0.0, 1.0 - r * r))), vec3(-0.45, 0.55, 0.70));\n"
    "ambientColor *= lit; diffuseColor *= 0.0;\n"
    "opacity *= 1.0 - smoothstep(0.84, 1.0, r);\n";

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
  vtkNew<vtkPolyData> balls, lines;
  vtkNew<vtkPointGaussianMapper> ball_mapper;
  vtkNew<vtkPolyDataMapper> line_mapper;
  vtkNew<vtkActor> ball_actor, line_actor;
};

EditMarkers::EditMarkers(vtkRenderer& renderer) : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  m.ball_mapper->SetInputData(m.balls);
  m.ball_mapper->EmissiveOff();
  m.ball_mapper->SetScaleFactor(1);
  m.ball_mapper->SetScaleArray("radius");
  m.ball_mapper->SetTriangleScale(1.5);
  m.ball_mapper->SetSplatShaderCode(kBall);
  m.ball_mapper->SetColorModeToDirectScalars();
  m.ball_actor->SetMapper(m.ball_mapper);
  m.ball_actor->ForceTranslucentOn();
  m.ball_actor->GetProperty()->SetAmbient(1);
  m.ball_actor->GetProperty()->SetDiffuse(0);
  m.line_mapper->SetInputData(m.lines);
  m.line_actor->SetMapper(m.line_mapper);
  m.line_actor->GetProperty()->LightingOff();
  m.line_actor->GetProperty()->SetLineWidth(2);
  renderer.AddActor(m.line_actor);
  renderer.AddActor(m.ball_actor);
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
    colours->InsertNextTypedTuple(look_of(line.look).colour.data());
  }
  Impl& m = *impl_;
  m.line_actor->SetVisibility(points->GetNumberOfPoints() > 0);
  m.lines->SetPoints(points);
  m.lines->SetLines(cells);
  m.lines->GetCellData()->SetScalars(colours);
}

void EditMarkers::fit(const ScreenMap& map, double unit) {
  Impl& m = *impl_;
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> radius;
  vtkNew<vtkUnsignedCharArray> colours;
  radius->SetName("radius");
  colours->SetNumberOfComponents(4);
  colours->SetName("colour");
  const auto add = [&](const Marker& marker, double radius_px, std::array<unsigned char, 3> c, unsigned char opacity) {
    points->InsertNextPoint(marker.position_m.x, marker.position_m.y, marker.position_m.z);
    radius->InsertNextValue(float(radius_px * unit * map.metres_per_pixel(marker.position_m)));
    const unsigned char rgba[] = {c[0], c[1], c[2], opacity};
    colours->InsertNextTypedTuple(rgba);
  };
  for (const Marker& marker : m.markers) {
    const Look look = look_of(marker.look);
    const double r = look.radius_px * (marker.selected ? 1.25 : 1.0);
    if (marker.look != MarkerLook::dot) {  // a shadow and a light rim: seen on any ground
      add(marker, r + (marker.selected ? 6.0 : 4.2), {30, 34, 40}, marker.selected ? 230 : 90);
      add(marker, r + (marker.selected ? 3.4 : 2.2), {255, 255, 255}, 255);
    }
    add(marker, r, look.colour, 255);
  }
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) cells->InsertNextCell(1, &i);
  m.ball_actor->SetVisibility(points->GetNumberOfPoints() > 0);
  m.balls->SetPoints(points);
  m.balls->SetVerts(cells);
  m.balls->GetPointData()->SetScalars(colours);
  m.balls->GetPointData()->AddArray(radius);
}

}  // namespace witherfield::vis
