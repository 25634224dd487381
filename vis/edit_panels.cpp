#include "vis/edit_panels.hpp"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "vis/overlay.hpp"

namespace witherfield::vis {
namespace {

constexpr glm::dvec3 kWhite{1, 1, 1}, kDark{0.12, 0.14, 0.17}, kDarkInk{0.93, 0.95, 0.97}, kDarkFaint{0.70, 0.76, 0.82};
constexpr glm::dvec3 kAmber{0.62, 0.30, 0.02}, kGreen{0.06, 0.36, 0.20};

/// One block of text of one style.
class Block {
 public:
  Block(vtkRenderer& renderer, const glm::dvec3& colour, bool bold) : renderer_(renderer) {
    vtkTextProperty* p = actor_->GetTextProperty();
    p->SetFontFamilyToArial();
    p->SetBold(bold);
    p->SetColor(colour.r, colour.g, colour.b);
    p->SetLineSpacing(1.22);
    p->SetVerticalJustificationToTop();
    p->SetJustificationToLeft();
    renderer.AddActor2D(actor_);
    set("");
  }
  void set(const std::string& text) {
    if (text == text_) return;
    text_ = text;
    actor_->SetInput(text.c_str());
  }
  void colour(const glm::dvec3& c) { actor_->GetTextProperty()->SetColor(c.r, c.g, c.b); }
  bool empty() const { return text_.empty(); }
  glm::dvec2 size(int font_px) {
    if (text_.empty()) return {0, 0};
    actor_->GetTextProperty()->SetFontSize(font_px);
    double box[4];
    actor_->GetBoundingBox(&renderer_, box);
    return {box[1] - box[0] + 1, box[3] - box[2] + 1};
  }
  /// Upper left corner, in pixels from the lower left of the window.
  void place(double x, double y, bool visible = true) {
    actor_->SetVisibility(visible && !text_.empty());
    actor_->SetPosition(std::round(x), std::round(y));
  }

 private:
  vtkRenderer& renderer_;
  vtkNew<vtkTextActor> actor_;
  std::string text_ = "?";
};

/// A rectangle with round corners.
class Sheet {
 public:
  Sheet(vtkRenderer& renderer, const glm::dvec3& colour, double opacity) {
    mapper_->SetInputData(data_);
    actor_->SetMapper(mapper_);
    actor_->GetProperty()->SetColor(colour.r, colour.g, colour.b);
    actor_->GetProperty()->SetOpacity(opacity);
    renderer.AddActor2D(actor_);
    hide();
  }
  void hide() { actor_->VisibilityOff(); }
  void place(double left, double bottom, double right, double top, double radius) {
    constexpr int kSteps = 6;
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    const double x[] = {right - radius, left + radius, left + radius, right - radius};
    const double y[] = {top - radius, top - radius, bottom + radius, bottom + radius};
    cells->InsertNextCell(4 * (kSteps + 1));
    for (int corner = 0; corner < 4; ++corner)
      for (int k = 0; k <= kSteps; ++k) {
        const double a = std::numbers::pi / 2 * (corner + double(k) / kSteps);
        cells->InsertCellPoint(
            points->InsertNextPoint(x[corner] + radius * std::cos(a), y[corner] + radius * std::sin(a), 0));
      }
    data_->SetPoints(points);
    data_->SetPolys(cells);
    actor_->VisibilityOn();
  }

 private:
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkPolyDataMapper2D> mapper_;
  vtkNew<vtkActor2D> actor_;
};

std::string column(const PanelRows& rows, bool second) {
  std::string text;
  for (const auto& row : rows) text += (&row == rows.data() ? "" : "\n") + (second ? row.second : row.first);
  return text;
}

/// A sheet with a heading over two columns.
struct Table {
  Sheet sheet;
  Block heading, names, values;
  Table(vtkRenderer& r, const glm::dvec3& ground, double opacity, const glm::dvec3& head, const glm::dvec3& faint,
        const glm::dvec3& ink)
      : sheet(r, ground, opacity), heading(r, head, true), names(r, faint, false), values(r, ink, false) {}

  void set(const std::string& title, const PanelRows& rows) {
    heading.set(title);
    names.set(column(rows, false));
    values.set(column(rows, true));
  }
  /// `at`(size) = upper left corner for a sheet of that size.
  template <class At>
  void lay_out(double unit, int font, int head_font, double pad, double gap, const At& at) {
    if (heading.empty()) {
      sheet.hide();
      for (Block* b : {&heading, &names, &values}) b->place(0, 0, false);
      return;
    }
    const glm::dvec2 h = heading.size(head_font), n = names.size(font), v = values.size(font);
    pad *= unit;
    gap *= unit;
    const double under_heading = names.empty() ? 0 : 9 * unit;
    const glm::dvec2 size{2 * pad + std::max(h.x, n.x + gap + v.x), 2 * pad + h.y + under_heading + std::max(n.y, v.y)};
    const glm::dvec2 corner = at(size);
    sheet.place(corner.x, corner.y - size.y, corner.x + size.x, corner.y, 8 * unit);
    heading.place(corner.x + pad, corner.y - pad);
    const double top = corner.y - pad - h.y - under_heading;
    names.place(corner.x + pad, top);
    values.place(corner.x + pad + n.x + gap, top);
  }
};

/// A sheet around one line, centred.
struct Strip {
  Sheet sheet;
  Block text;
  Strip(vtkRenderer& r, const glm::dvec3& ground, double opacity, const glm::dvec3& ink, bool bold)
      : sheet(r, ground, opacity), text(r, ink, bold) {}
  void lay_out(double unit, int font, double middle_x, double bottom) {
    if (text.empty()) {
      sheet.hide();
      text.place(0, 0, false);
      return;
    }
    const glm::dvec2 size = text.size(font);
    const double x = 14 * unit, y = 8 * unit;
    sheet.place(middle_x - size.x / 2 - x, bottom, middle_x + size.x / 2 + x, bottom + size.y + 2 * y, 8 * unit);
    text.place(middle_x - size.x / 2, bottom + y + size.y);
  }
};

}  // namespace

struct EditPanels::Impl {
  Table panel;
  Strip hint, notice;
  Table help;  // last: it lies over the rest
  explicit Impl(vtkRenderer& r)
      : panel(r, kWhite, 0.82, kInk, kFaintInk, kInk), hint(r, kWhite, 0.70, kFaintInk, false),
        notice(r, kWhite, 0.92, kGreen, true), help(r, kDark, 0.90, kWhite, kDarkFaint, kDarkInk) {}
};

EditPanels::EditPanels(vtkRenderer& renderer) : impl_(std::make_unique<Impl>(renderer)) {}
EditPanels::~EditPanels() = default;

void EditPanels::set_panel(const std::string& heading, const PanelRows& rows) { impl_->panel.set(heading, rows); }
void EditPanels::set_hint(const std::string& hint) { impl_->hint.text.set(hint); }
void EditPanels::set_notice(const std::string& text, bool is_warning) {
  impl_->notice.text.set(text);
  impl_->notice.text.colour(is_warning ? kAmber : kGreen);
}
void EditPanels::set_help(const std::string& heading, const PanelRows& rows) { impl_->help.set(heading, rows); }

void EditPanels::lay_out(int width, int height, double unit) {
  Impl& m = *impl_;
  const auto font = [&](double px) { return int(std::lround(px * unit)); };
  const double edge = 16 * unit;
  m.panel.lay_out(unit, font(14), font(17), 13, 16, [&](const glm::dvec2&) { return glm::dvec2(edge, height - edge); });
  m.hint.lay_out(unit, font(13), width / 2.0, edge);
  m.notice.lay_out(unit, font(15), width / 2.0, edge + 44 * unit);
  m.help.lay_out(unit, font(15), font(20), 26, 30, [&](const glm::dvec2& size) {
    return glm::dvec2((width - size.x) / 2, (height + size.y) / 2);
  });
}

}  // namespace witherfield::vis
