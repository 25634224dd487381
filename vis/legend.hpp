// What is written around the data in a picture: colour bar or legend, caption, box with axes. Drawn into a
// vtkRenderer.
#pragma once
#include <array>
#include <string>

#include "vis/colour_map.hpp"
#include "vis/framing.hpp"

class vtkRenderer;

namespace witherfield::vis {

/// Sizes of the picture's parts, in pixels; everything scales with the picture. The legend has a strip of its
/// own on the right, so that a zoomed view does not run under it.
struct Layout {
  int width_px = 0;   ///< of the data's part
  int legend_px = 0;  ///< of the legend's
  int height_px = 0;
  double unit = 1;  ///< 1 at 1280 x 720
  Layout(int width, int height);
  int font(double size) const;
  /// Room of the data within its part, with space for the axes' numbers around it.
  std::array<double, 4> data_rectangle() const;
};

/// In the legend's renderer: colour bar with ticks, or a list of categories; title above it with its unit (""
/// = none) on a line of its own.
void add_colour_bar(vtkRenderer& renderer, const Layout& layout, const ColourMap& map,
                    const std::string& title, const std::string& unit);
/// In the legend's renderer: text alone where the colour bar would be (colours that are the data themselves).
void add_legend_text(vtkRenderer& renderer, const Layout& layout, const std::string& text);
/// Upper left corner of the data's renderer.
void add_caption(vtkRenderer& renderer, const Layout& layout, const std::string& text);
/// In the data's renderer: the ground rectangle of the box (filled if `ground`: flat data would lie in it), a vertical edge, and ticks with numbers and names
/// on the edges toward the viewer.
void add_axes(vtkRenderer& renderer, const Layout& layout, const Framing& framing,
              const std::array<double, 6>& bounds, const std::string& length_unit, bool ground = true);

/// "ug/cm2" -> "µg/cm²" and the like, for people's eyes.
std::string typeset_unit(const std::string& unit);

}  // namespace witherfield::vis
