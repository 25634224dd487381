// A film of something that hardly moves: a few key pictures are rendered, the pictures between them are interpolated in
// scene radiance, pixel by pixel. Where light falls and where the camera stands does not change, so radiance follows the
// floor's reflectance (linearly, but for mirror images and light that has met the floor twice); how far the interpolated
// picture is from a rendered one is measured, and key pictures are added until that is below a bound.
//
// Nothing here renders or writes: pictures come from a callback.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "pov/hdr.hpp"

namespace witherfield::pov {

/// How two pictures differ as they are shown: levels of 255 of an sRGB picture, over all pixels and channels.
struct PictureDifference {
  double mean = 0;  ///< of the absolute differences
  double rms = 0;
  double p999 = 0;  ///< 99.9 % of all values differ by no more (to a twentieth of a level; at most 255)
};
/// @throws InvalidInput when the sizes differ.
PictureDifference difference(const HdrImage& a, const HdrImage& b, double exposure);

struct KeyPicture {
  double moment = 0;  ///< share of the visits, weathering degree ...
  HdrImage image;
};
/// The exact picture at a moment.
using PictureAt = std::function<HdrImage(double moment)>;

struct KeyOptions {
  double exposure = 1;
  double bound_rms = 1;   ///< levels; largest blend error that needs no further key, > 0
  int max_keys = 33;      ///< 2..1000
};

struct KeySet {
  std::vector<KeyPicture> keys;  ///< ascending
  /// Largest difference between a rendered picture and the blend of its neighbours, among the intervals that were not
  /// divided further. The rendered one has become a key itself, so the film is nearer to the truth than this.
  PictureDifference blend_error;
  double worst_moment = 0;
  int gaps_left = 0;             ///< that nobody has looked into, because max_keys was reached; 0 = the bound holds
};
/// Begins with the first and the last moment and renders a picture inside each gap: at the `moments` nearest to its middle, if
/// there is one in the gap, else in the middle (of the moments' roots: wear slows down). Where it differs from the blend of
/// the gap's ends by more than the bound, both halves are treated likewise.
/// @param moments ascending, at least 2, >= 0. @throws InvalidInput.
KeySet choose_keys(std::span<const double> moments, const PictureAt& picture_at, const KeyOptions& options);

/// Moments of the film's keys on the film's own clock, 0..1.
enum class Pace {
  even,  ///< the picture changes by the same amount (rms) from frame to frame
  time,  ///< the moment passes evenly
};
std::vector<double> film_clock(std::span<const KeyPicture> keys, Pace pace, double exposure);
/// The moment shown at `clock` (0..1): monotone through the keys.
double moment_at(std::span<const KeyPicture> keys, std::span<const double> clock, double at);

/// The film's picture at `at` (0..1): at a key the key itself, in between each value within the range of its two
/// neighbours (sim/core/monotone.hpp).
HdrImage picture_between(std::span<const KeyPicture> keys, std::span<const double> clock, double at);

/// Statistics of the frames as they are handed to the encoder, 8-bit sRGB.
class FrameWatch {
 public:
  void add(std::span<const std::uint8_t> rgb);

  int frames() const { return frames_; }
  int neighbour_max() const { return neighbour_max_; }              ///< levels: largest change of any value in a frame
  /// Levels: 999 of 1000 values change by no more, in every frame. What is left over are glints.
  int neighbour_p999() const { return neighbour_p999_; }
  double neighbour_mean_max() const { return neighbour_mean_max_; } ///< levels: largest mean change of a frame
  double from_first() const { return from_first_.empty() ? 0 : from_first_.back(); }  ///< mean levels, last frame
  /// Mean difference from the first frame at every frame.
  const std::vector<double>& growth() const { return from_first_; }
  /// Largest fall of that difference below what it had been before.
  double largest_fall() const { return largest_fall_; }
  /// Sum of all mean changes over the mean difference last - first: 1 when no pixel ever turns back; 0 frames: 1.
  double detour() const;

 private:
  std::vector<std::uint8_t> first_, last_;
  std::vector<double> from_first_;
  int frames_ = 0, neighbour_max_ = 0, neighbour_p999_ = 0;
  double neighbour_mean_max_ = 0, path_ = 0, highest_ = 0, largest_fall_ = 0;
};

}  // namespace witherfield::pov
