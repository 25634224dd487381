// Counter-based random numbers: a draw depends only on (seed, what, index, draw number), never on the order or the
// thread in which it is made. Philox4x32-10 (Salmon, Moraes, Dror, Shaw 2011, "Parallel random numbers: as easy as 1, 2, 3").
#pragma once
#include <array>
#include <cstdint>

namespace witherfield {

/// One block of Philox4x32-10.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// What a stream is for; streams of different purpose never overlap.
enum class Stream : std::uint32_t { blades = 1, clumps, point_count, point_place, placement, onset, colour, noise, variant, test,
                                    kernels, outline, walker, footprint, floor_material };

/// A stream of draws keyed by (seed, what, index).
class Random {
 public:
  Random(std::uint64_t seed, Stream what, std::uint64_t index);
  std::uint32_t bits();
  double uniform();                        ///< [0, 1), 32 random bits
  double uniform(double lo, double hi);
  double normal();                         ///< mean 0, sd 1 (Box-Muller)
  double truncated_normal(double mean, double sd, double lo, double hi);  ///< by rejection, clamped after 64 tries

 private:
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> block_{};
  int used_ = 4;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace witherfield
