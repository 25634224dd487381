// Sole masks: what a foot presses on and where it slides, made from anatomical pressure zones, or the user's own.
// A mask lies with its heel to the left and its toe to the right (+x), seen from above; it shows a right foot.
#pragma once
#include <vector>

#include "sim/floor/footprint.hpp"

namespace witherfield::floor {

struct Mask {
  int size = 0;                 ///< a: cells along an edge, odd; the centre of rotation is cell (a - 1) / 2
  double pixels_per_m = 0;
  std::vector<float> pressure;  ///< grey of the paper, highest value 1; index j * size + i, j upward
  std::vector<float> slide;     ///< local sliding path over slip_m, 0..1
  double pressure_sum() const;
};

/// One of our soles. @param size odd, or 0: as large as needed for any turn. @throws InvalidInput when even or too small.
Mask make_mask(Sole sole, double foot_length_m, double pixels_per_m, int size = 0);

/// The user's, at the floor's resolution; it slides as a whole. @throws InvalidInput naming the mask when its size is
/// not odd, a value is outside 0..1 or nothing is above 0.
Mask make_mask(const UserMask& mask, double pixels_per_m);
void validate(const UserMask& mask);

/// Rotation by part / whole of a full turn; quarter turns are exact.
struct Rotation { double cos, sin; };
Rotation rotation(int part, int whole);

/// B_ij = A_xy, turned counter-clockwise about the middle with bilinear interpolation, with
///     x = c + (i - c) cos + (j - c) sin,   y = c + (j - c) cos - (i - c) sin,   c = (a - 1) / 2.
/// (Su et al. 1998, sec. 2.3, print the second with a plus, which is no rotation, and c = (a + 1) / 2.)
/// The result is `out_size` wide (odd), with its own middle; nothing outside `values`.
std::vector<float> rotate(const std::vector<float>& values, int size, Rotation by, int out_size);

/// All soles of a run, by sole and size.
class SoleSet {
 public:
  explicit SoleSet(const FloorOptions& options);
  const std::vector<Mask>& masks() const { return masks_; }
  /// Which of masks() a footprint shows.
  int mask_of(const Footprint& print) const;

 private:
  std::vector<Mask> masks_;
  int sizes_ = 1;
  bool own_ = false;
  double first_m_[2] = {0, 0}, step_m_[2] = {0, 0};  // foot lengths of men's and women's sizes
};

}  // namespace witherfield::floor
