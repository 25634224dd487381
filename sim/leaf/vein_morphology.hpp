// A leaf from the proportions of its veins: only the length of the main vein is entered (Miao et al., sec. 1).
#pragma once
#include <vector>

#include "sim/leaf/leaf_model.hpp"

namespace witherfield::leaf {

/// Outline points, dense, in the plane z = 0, and the main veins (vein 0 = midrib; those of lobes have a parent).
struct VeinDraft {
  OutlinePoints points;
  std::vector<Vein> veins;
};

/// Closed interval from which a proportion is drawn.
struct Span {
  double lo = 0, hi = 0;
};

/// One half of a cucumber leaf. Lengths over OE, angles from the midrib. Names of the points as in the paper's fig. 2.
/// The paper prints neither ratios nor angles (its Table 1 holds correlations only): these are reconstructed from
/// leaves' usual shape, and are to be replaced by measurements where there are some.
struct CucumberHalf {
  double upper = 0, upper_deg = 0, upper_bend_deg = 0;  ///< OC + CG over OE, angle COE, turn at C towards the tip
  double basal = 0, basal_deg = 0, basal_bend_deg = 0;  ///< OA + AF over OE, angle AOE, turn at A away from the tip
  double sinus_tip = 0, sinus_side = 0;                 ///< depth of the outline below the straight lines E-G and G-F, over their length
  double lobe = 0, lobe_deg = 0;                        ///< where the quadratic curve F-O is widest
};
struct CucumberSpans {
  Span upper{0.80, 0.86}, upper_deg{42, 50}, upper_bend_deg{2, 8};
  Span basal{0.64, 0.72}, basal_deg{97, 108}, basal_bend_deg{3, 10};
  Span sinus_tip{0.09, 0.13}, sinus_side{0.05, 0.09};
  Span lobe{0.52, 0.58}, lobe_deg{140, 148};
};

/// @throws InvalidInput for an unknown species.
VeinDraft vein_draft(const LeafOptions& options);

}  // namespace witherfield::leaf
