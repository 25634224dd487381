// DF3, POV-Ray's density file: three big-endian u16 (x, y, z in POV-Ray's axes), then 8-bit samples, x
// fastest. Traps (read from POV-Ray's own reader): sample i sits at i/N of the unit cube, not at (i + 1/2)/N,
// and interpolation wraps from the last sample to the first.
#pragma once
#include <span>
#include <string>

namespace witherfield::pov {

/// 8-bit DF3 of `values` (ours: x fastest, then y, then z up), each divided by `full` and clamped to [0, 1].
/// POV-Ray's y is our z, its z is our y: the two are exchanged here.
/// @throws InvalidInput when a side is not in 1..65535 or the number of values does not fit.
std::string encode_df3(std::span<const float> values, int nx, int ny, int nz, double full);

}  // namespace witherfield::pov
