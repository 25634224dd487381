// Water and chlorophyll over the season (Jiao et al. 2010, fig. 9; the figure's curves are replaced by the fitted logistic
// ones, shaped by published senescence data).
#pragma once
#include "sim/core/curve.hpp"
#include "sim/grass/options.hpp"

namespace witherfield::grass {

/// Normalised falling logistic on [0, 1]: 1 at 0, `end` at 1.  L(x) = 1 / (1 + exp((x - mid) / slope)).
double falling_logistic(double wd, double mid, double slope, double end);

/// Canopy curves of a season (either the climate's or the user's key frames). 1 when fresh.
class SeasonCurves {
 public:
  /// @throws InvalidInput for user curves that are not monotone, leave 0..1, or whose keys do not ascend.
  explicit SeasonCurves(const SeasonOptions& options);
  double water(double wd) const;                ///< relative water content of the canopy, 0..1
  double chlorophyll(double wd) const;          ///< fraction of the fresh content, canopy mean
  /// One spot of one blade: `onset` is the blade's (Blade::onset), arc 0 root .. 1 tip. The spot lives on the warped
  /// time spot_wd(wd, onset, arc), and loses its chlorophyll in about a week once its turn comes (Mattila et al. 2018).
  double spot_wd(double wd, double onset, double arc) const;
  double spot_water(double wd, double onset, double arc) const;
  double spot_chlorophyll(double wd, double onset, double arc) const;

 private:
  SeasonOptions options_;
  Curve water_, chlorophyll_;
};

}  // namespace witherfield::grass
