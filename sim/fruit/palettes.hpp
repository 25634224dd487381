// Colours of the organs of the built-in crops, green and ripe.
#pragma once
#include "sim/fruit/organ.hpp"
#include "sim/fruit/ripening.hpp"

namespace witherfield::fruit {

/// Colours along an organ and at its marked places.
struct Palette {
  ColourRamp root, middle, tip, mark;
  /// @param brightness factor on all colours (kernel to kernel); mottle, phase: see Coat.
  Coat coat(double ripeness, double brightness, double mottle, double phase) const;
};

// Ripe straw lies between dry grass sod (169,148,122; docs/physics.md) and the warmer gold of ears in
// sunlight; green between maize leaf (89,100,68) and the lighter, waxy bloom of young husks.
const Palette& wheat_husk_palette();    ///< mark: papery rim
const Palette& wheat_kernel_palette();  ///< mark: groove
const Palette& awn_palette();
const Palette& straw_palette();
const Palette& maize_kernel_palette();  ///< from the pale base to the deep yellow flank; mark: floury crown
const Palette& cob_palette();
const Palette& maize_shank_palette();
const Palette& sepal_palette();

}  // namespace witherfield::fruit
