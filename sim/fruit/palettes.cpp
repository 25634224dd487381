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
  static const Palette p = make({{0, {138, 160, 92}}, {0.55, {186, 176, 98}}, {1, {214, 178, 112}}},
                                {{0, {104, 134, 72}}, {0.55, {168, 162, 82}}, {1, {208, 166, 96}}},
                                {{0, {120, 146, 80}}, {0.55, {184, 170, 90}}, {1, {222, 184, 116}}},
                                {{0, {150, 172, 108}}, {0.55, {204, 190, 122}}, {1, {232, 204, 146}}});
  return p;
}

const Palette& wheat_kernel_palette() {
  static const Palette p = make({{0, {150, 168, 88}}, {0.55, {190, 168, 88}}, {1, {196, 138, 78}}},
                                {{0, {124, 152, 70}}, {0.55, {188, 160, 78}}, {1, {188, 122, 62}}},
                                {{0, {140, 160, 86}}, {0.55, {196, 172, 98}}, {1, {206, 156, 96}}},
                                {{0, {96, 124, 54}}, {0.55, {140, 116, 54}}, {1, {126, 76, 38}}});
  return p;
}

const Palette& awn_palette() {
  static const Palette p = make({{0, {128, 152, 84}}, {0.55, {188, 176, 98}}, {1, {216, 178, 110}}},
                                {{0, {146, 164, 96}}, {0.55, {200, 184, 112}}, {1, {224, 188, 124}}},
                                {{0, {168, 172, 112}}, {0.55, {208, 190, 124}}, {1, {228, 196, 136}}},
                                {{0, {146, 164, 96}}, {1, {224, 188, 124}}});
  return p;
}

const Palette& straw_palette() {
  static const Palette p = make({{0, {112, 140, 72}}, {0.55, {170, 168, 88}}, {1, {206, 170, 98}}},
                                {{0, {116, 144, 76}}, {0.55, {176, 170, 90}}, {1, {212, 176, 106}}},
                                {{0, {128, 152, 84}}, {0.55, {184, 174, 96}}, {1, {214, 180, 112}}},
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
