#include "vis/overlay.hpp"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

namespace witherfield::vis {

void Overlay::tiles(const std::vector<Tile>& tiles) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  colours->SetName("colour");
  for (const Tile& t : tiles) {
    const vtkIdType first = points->InsertNextPoint(t.lo.x, t.lo.y, 0);
    points->InsertNextPoint(t.hi.x, t.lo.y, 0);
    points->InsertNextPoint(t.hi.x, t.hi.y, 0);
    points->InsertNextPoint(t.lo.x, t.hi.y, 0);
    const vtkIdType corners[] = {first, first + 1, first + 2, first + 3};
    cells->InsertNextCell(4, corners);
    unsigned char rgb[3];
    for (int c = 0; c < 3; ++c) rgb[c] = static_cast<unsigned char>(std::lround(t.colour[c] * 255));
    colours->InsertNextTypedTuple(rgb);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetCellData()->SetScalars(colours);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  renderer_.AddActor2D(actor);
}

void Overlay::lines(const std::vector<std::pair<glm::dvec2, glm::dvec2>>& lines, double width_px,
                    const glm::dvec3& colour) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b] : lines) {
    const vtkIdType first = points->InsertNextPoint(a.x, a.y, 0);
    points->InsertNextPoint(b.x, b.y, 0);
    const vtkIdType ends[] = {first, first + 1};
    cells->InsertNextCell(2, ends);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour.r, colour.g, colour.b);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width_px));
  renderer_.AddActor2D(actor);
}

void Overlay::text(const std::string& text, const glm::dvec2& at, int font_px, Align align,
                   const glm::dvec3& colour, double backing) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->SetPosition(std::round(at.x), std::round(at.y));
  vtkTextProperty* p = actor->GetTextProperty();
  p->SetFontFamilyToArial();
  p->SetFontSize(font_px);
  p->SetColor(colour.r, colour.g, colour.b);
  p->SetVerticalJustificationToCentered();
  p->SetLineSpacing(1.15);
  p->SetBackgroundColor(kPaper.r, kPaper.g, kPaper.b);
  p->SetBackgroundOpacity(backing);
  if (align == Align::left) p->SetJustificationToLeft();
  if (align == Align::centre) p->SetJustificationToCentered();
  if (align == Align::right) p->SetJustificationToRight();
  renderer_.AddActor2D(actor);
}

}  // namespace witherfield::vis
