#include "vis/legend.hpp"

#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

#include "vis/overlay.hpp"
#include "vis/ticks.hpp"

namespace witherfield::vis {
namespace {

/// Breaks a title into lines of at most `columns` characters where words allow.
std::string wrapped(const std::string& text, std::size_t columns, int& lines) {
  std::string out;
  std::size_t in_line = 0, at = 0;
  lines = 1;
  while (at < text.size()) {
    const std::size_t space = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, space - at);
    if (in_line && in_line + 1 + word.size() > columns) {
      out += '\n';
      in_line = 0;
      ++lines;
    } else if (in_line) {
      out += ' ';
      ++in_line;
    }
    out += word;
    in_line += word.size();
    at = space + 1;
  }
  return out;
}

struct BarPlace {
  glm::dvec2 lo, hi;
};

BarPlace bar_place(const Layout& l) {
  const double left = 62 * l.unit, bottom = 0.17 * l.height_px, top = 0.72 * l.height_px;
  return {{left, bottom}, {left + 24 * l.unit, top}};
}

void add_scale(Overlay& overlay, const Layout& l, const ColourMap& map) {
  const BarPlace bar = bar_place(l);
  constexpr int kSteps = 256;
  std::vector<Overlay::Tile> tiles;
  for (int i = 0; i < kSteps; ++i) {
    const auto y = [&](int n) { return bar.lo.y + (bar.hi.y - bar.lo.y) * n / kSteps; };
    tiles.push_back(
        {{bar.lo.x, y(i)}, {bar.hi.x, y(i + 1)}, map.at(map.lo + (map.hi - map.lo) * (i + 0.5) / kSteps)});
  }
  overlay.tiles(tiles);
  const glm::dvec2 lo = bar.lo, hi = bar.hi;
  overlay.lines({{lo, {hi.x, lo.y}}, {{hi.x, lo.y}, hi}, {hi, {lo.x, hi.y}}, {{lo.x, hi.y}, lo}}, 1,
                kFaintInk);
  const Ticks t = ticks(map.lo, map.hi, 5);
  std::vector<std::pair<glm::dvec2, glm::dvec2>> marks;
  for (std::size_t i = 0; i < t.values.size(); ++i) {
    const double y = lo.y + (hi.y - lo.y) * (t.values[i] - map.lo) / (map.hi - map.lo);
    marks.push_back({{hi.x, y}, {hi.x + 6 * l.unit, y}});
    overlay.text(t.labels[i], {hi.x + 11 * l.unit, y}, l.font(17), Align::left, kInk);
  }
  overlay.lines(marks, 1, kFaintInk);
}

void add_categories(Overlay& overlay, const Layout& l, const ColourMap& map) {
  const BarPlace bar = bar_place(l);
  const double swatch = 24 * l.unit, step = 36 * l.unit;
  std::vector<Overlay::Tile> tiles;
  double y = bar.hi.y - swatch;
  // Value 0 is the absence of everything and never drawn.
  for (std::size_t i = 1; i < map.categories.size(); ++i, y -= step) {
    tiles.push_back(
        {{bar.lo.x - 24 * l.unit, y}, {bar.lo.x - 24 * l.unit + swatch, y + swatch}, map.colours[i]});
    overlay.text(map.categories[i], {bar.lo.x + 10 * l.unit, y + swatch / 2}, l.font(17), Align::left, kInk);
  }
  overlay.tiles(tiles);
}

}  // namespace

Layout::Layout(int width, int height) : height_px(height), unit(std::min(width / 1280.0, height / 720.0)) {
  legend_px = static_cast<int>(std::lround(192 * unit));
  width_px = width - legend_px;
}

int Layout::font(double size) const {
  return std::max(7, static_cast<int>(std::lround(size * unit)));
}

std::array<double, 4> Layout::data_rectangle() const {
  return {96 * unit, width_px - 84 * unit, 84 * unit, height_px - 64 * unit};
}

void add_colour_bar(vtkRenderer& renderer, const Layout& l, const ColourMap& map, const std::string& title,
                    const std::string& unit) {
  Overlay overlay(renderer);
  const BarPlace bar = bar_place(l);
  int lines = 0;
  std::string text = wrapped(title, 16, lines);
  if (!unit.empty()) {
    text += "\n(" + unit + ")";
    ++lines;
  }
  const double middle = bar.hi.y + (18 + 11 * lines) * l.unit;
  overlay.text(text, {bar.lo.x + 18 * l.unit, middle}, l.font(18), Align::centre, kInk);
  if (map.cyclic_labels) return;
  if (map.categories.empty())
    add_scale(overlay, l, map);
  else
    add_categories(overlay, l, map);
}

void add_legend_text(vtkRenderer& renderer, const Layout& l, const std::string& text) {
  const BarPlace bar = bar_place(l);
  int lines = 0;
  const std::string broken = wrapped(text, 16, lines);
  Overlay(renderer).text(broken, {bar.lo.x + 18 * l.unit, bar.hi.y}, l.font(18), Align::centre, kInk);
}

void add_caption(vtkRenderer& renderer, const Layout& l, const std::string& text) {
  Overlay(renderer).text(text, {22 * l.unit, l.height_px - 30 * l.unit}, l.font(22), Align::left, kInk, 0.8);
}

std::string typeset_unit(const std::string& unit) {
  std::string out;
  if (unit == "1") return "\u2013";  // a dash: dimensionless
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const bool after_letter = i > 0 && std::isalpha(static_cast<unsigned char>(unit[i - 1]));
    if (unit[i] == 'u' && i + 1 < unit.size() && unit[i + 1] == 'g')
      out += "\u00b5";
    else if (unit[i] == '2' && after_letter)
      out += "\u00b2";
    else if (unit[i] == '3' && after_letter)
      out += "\u00b3";
    else
      out += unit[i];
  }
  return out;
}

}  // namespace witherfield::vis
