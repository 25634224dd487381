#include "sim/fruit/palettes.hpp"

namespace witherfield::fruit {
namespace {

using Keys = std::vector<std::pair<double, Srgb>>;

Palette make(Keys root, Keys middle, Keys tip, Keys mark) {
  return {ColourRamp(std::move(root)), ColourRamp(std::move(middle)), ColourRamp(std::move(tip)),
          ColourRamp(std::move(mark))};
}

}  // namespace

Coat Palette::coat(double ripeness, double brightness, double mottle, double phase) const {
  Coat c;
  const float b = float(brightness);
  c.along = {root(ripeness) * b, middle(ripeness) * b, tip(ripeness) * b};
  c.mark = mark(ripeness) * b;
  c.mottle = float(mottle);
  c.mottle_phase = float(phase);
  return c;
}

const Palette& wheat_husk_palette() {
  static const Palette p = make({{0, {172, 186, 122}}, {0.55, {204, 194, 122}}, {1, {228, 202, 146}}},
                                {{0, {142, 166, 100}}, {0.55, {190, 182, 106}}, {1, {222, 188, 126}}},
                                {{0, {154, 174, 108}}, {0.55, {200, 186, 112}}, {1, {230, 198, 138}}},
                                {{0, {184, 198, 144}}, {0.55, {214, 202, 144}}, {1, {240, 220, 174}}});
  return p;
}

const Palette& wheat_kernel_palette() {
  static const Palette p = make({{0, {160, 178, 100}}, {0.55, {200, 178, 104}}, {1, {204, 156, 102}}},
                                {{0, {136, 162, 84}}, {0.55, {196, 170, 94}}, {1, {200, 146, 90}}},
                                {{0, {152, 170, 98}}, {0.55, {204, 182, 112}}, {1, {216, 176, 122}}},
                                {{0, {110, 136, 66}}, {0.55, {150, 126, 66}}, {1, {146, 98, 56}}});
  return p;
}

const Palette& awn_palette() {
  static const Palette p = make({{0, {148, 170, 104}}, {0.55, {200, 190, 116}}, {1, {224, 192, 130}}},
                                {{0, {164, 180, 114}}, {0.55, {210, 196, 126}}, {1, {230, 200, 142}}},
                                {{0, {184, 188, 130}}, {0.55, {216, 200, 138}}, {1, {234, 208, 154}}},
                                {{0, {146, 164, 96}}, {1, {224, 188, 124}}});
  return p;
}

const Palette& straw_palette() {
  static const Palette p = make({{0, {138, 164, 94}}, {0.55, {190, 186, 108}}, {1, {216, 186, 118}}},
                                {{0, {142, 168, 98}}, {0.55, {194, 188, 110}}, {1, {220, 190, 126}}},
                                {{0, {152, 174, 104}}, {0.55, {200, 190, 116}}, {1, {222, 194, 132}}},
                                {{0, {112, 140, 72}}, {1, {196, 160, 92}}});
  return p;
}

const Palette& maize_kernel_palette() {
  // The yellow of the flank is carotenoid in the horny endosperm; the crown of a dent kernel is floury and
  // paler.
  static const Palette p = make({{0, {228, 222, 158}}, {0.5, {236, 208, 122}}, {1, {224, 180, 100}}},
                                {{0, {234, 222, 138}}, {0.5, {238, 188, 58}}, {1, {216, 126, 14}}},
                                {{0, {240, 230, 156}}, {0.5, {244, 200, 70}}, {1, {230, 148, 22}}},
                                {{0, {244, 236, 180}}, {0.5, {246, 216, 104}}, {1, {240, 180, 58}}});
  return p;
}

const Palette& cob_palette() {
  static const Palette p =
      make({{0, {222, 222, 170}}, {1, {214, 182, 132}}}, {{0, {226, 224, 176}}, {1, {222, 192, 142}}},
           {{0, {228, 224, 178}}, {1, {216, 186, 138}}}, {{0, {206, 206, 150}}, {1, {190, 150, 104}}});
  return p;
}

const Palette& maize_shank_palette() {
  static const Palette p =
      make({{0, {176, 190, 120}}, {1, {206, 178, 122}}}, {{0, {182, 196, 128}}, {1, {212, 184, 130}}},
           {{0, {198, 206, 146}}, {1, {218, 190, 138}}}, {{0, {168, 182, 112}}, {1, {196, 166, 110}}});
  return p;
}

const Palette& sepal_palette() {
  static const Palette p =
      make({{0, {124, 152, 76}}, {1, {118, 140, 70}}}, {{0, {112, 144, 70}}, {1, {110, 132, 66}}},
           {{0, {132, 154, 84}}, {1, {140, 140, 80}}}, {{0, {150, 168, 100}}, {1, {150, 150, 96}}});
  return p;
}

}  // namespace witherfield::fruit
