// The box around the data: ground rectangle, one vertical edge, ticks and numbers where nothing covers them.
#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "vis/legend.hpp"
#include "vis/overlay.hpp"
#include "vis/ticks.hpp"

namespace witherfield::vis {
namespace {

using Segment = std::pair<glm::dvec3, glm::dvec3>;

void add_ground(vtkRenderer& renderer, const std::array<double, 6>& b) {
  vtkNew<vtkPoints> points;
  for (const auto& [x, y] : {std::pair{b[0], b[2]}, {b[1], b[2]}, {b[1], b[3]}, {b[0], b[3]}})
    points->InsertNextPoint(x, y, b[4]);
  vtkNew<vtkCellArray> cells;
  const vtkIdType corners[] = {0, 1, 2, 3};
  cells->InsertNextCell(4, corners);
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(0.915, 0.925, 0.93);
  renderer.AddActor(actor);
}

void add_segments(vtkRenderer& renderer, const std::vector<Segment>& segments, double width_px) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& [p, q] : segments) {
    const vtkIdType first = points->InsertNextPoint(p.x, p.y, p.z);
    points->InsertNextPoint(q.x, q.y, q.z);
    const vtkIdType ends[] = {first, first + 1};
    cells->InsertNextCell(2, ends);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(0.62, 0.65, 0.69);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width_px));
  renderer.AddActor(actor);
}

/// Ticks and numbers along the edge from `from` to `to`, where the coordinate runs from lo to hi; on the side
/// of `inside` that is away from it. Edges that are seen nearly end-on get none: their numbers would overlap.
void add_scale(Overlay& overlay, const Layout& l, const Framing& f, const glm::dvec3& from,
               const glm::dvec3& to, double lo, double hi, const glm::dvec2& inside,
               const std::string& name) {
  const glm::dvec2 a = f.project(from), b = f.project(to), along = b - a;
  const double length = glm::length(along);
  if (!(length > 90 * l.unit)) return;
  glm::dvec2 out = glm::dvec2(-along.y, along.x) / length;
  if (glm::dot(out, (a + b) * 0.5 - inside) < 0) out = -out;
  const bool sideways = std::abs(out.x) > 0.8;
  const Align align = std::abs(out.x) < 0.3 ? Align::centre : out.x > 0 ? Align::left : Align::right;

  const Ticks t = ticks(lo, hi, std::clamp(static_cast<int>(length / (90 * l.unit)), 2, 6));
  std::vector<std::pair<glm::dvec2, glm::dvec2>> marks;
  for (std::size_t i = 0; i < t.values.size(); ++i) {
    const glm::dvec2 p = f.project(from + (to - from) * ((t.values[i] - lo) / (hi - lo)));
    marks.push_back({p, p + out * (6 * l.unit)});
    overlay.text(t.labels[i], p + out * ((sideways ? 10 : 17) * l.unit), l.font(15), align, kFaintInk);
  }
  overlay.lines(marks, 1, kFaintInk);
  const double away = (sideways ? 56 : align == Align::centre ? 42 : 50) * l.unit;
  overlay.text(name, (a + b) * 0.5 + out * away, l.font(16), align, kInk);
}

}  // namespace

void add_axes(vtkRenderer& renderer, const Layout& l, const Framing& f, const std::array<double, 6>& b,
              const std::string& length_unit, bool ground) {
  const std::string unit = length_unit.empty() ? "" : " (" + length_unit + ")";
  // The vertical faces toward the viewer.
  const glm::dvec3 eye = f.position - f.focal_point;
  const double front_x = eye.x > 0 ? b[1] : b[0], front_y = eye.y > 0 ? b[3] : b[2];
  const double back_x = eye.x > 0 ? b[0] : b[1], back_y = eye.y > 0 ? b[2] : b[3];
  // The two outermost vertical edges; the scale stands at the left one, away from the colour bar.
  const glm::dvec3 one{back_x, front_y, b[4]}, two{front_x, back_y, b[4]};
  const glm::dvec3 left = f.project(one).x < f.project(two).x ? one : two;
  const glm::dvec3 left_top{left.x, left.y, b[5]};

  if (ground && eye.z > 0) add_ground(renderer, b);
  add_segments(renderer,
               {{{b[0], b[2], b[4]}, {b[1], b[2], b[4]}},
                {{b[1], b[2], b[4]}, {b[1], b[3], b[4]}},
                {{b[1], b[3], b[4]}, {b[0], b[3], b[4]}},
                {{b[0], b[3], b[4]}, {b[0], b[2], b[4]}},
                {left, left_top}},
               std::max(1.0, 1.2 * l.unit));

  Overlay overlay(renderer);
  const glm::dvec2 ground_middle = f.project({(b[0] + b[1]) / 2, (b[2] + b[3]) / 2, b[4]});
  add_scale(overlay, l, f, {b[0], front_y, b[4]}, {b[1], front_y, b[4]}, b[0], b[1], ground_middle,
            "x" + unit);
  add_scale(overlay, l, f, {front_x, b[2], b[4]}, {front_x, b[3], b[4]}, b[2], b[3], ground_middle,
            "y" + unit);
  const glm::dvec2 middle = f.project((glm::dvec3(b[0], b[2], b[4]) + glm::dvec3(b[1], b[3], b[5])) * 0.5);
  add_scale(overlay, l, f, left, left_top, b[4], b[5], middle, "z" + unit);
}

}  // namespace witherfield::vis
