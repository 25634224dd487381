// A footprint as it is kept and passed on: 32 bytes. A run of ten million steps is a file of 320 MB.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <span>

#include "sim/floor/options.hpp"

namespace witherfield::floor {

enum class Foot : std::uint8_t { left, right };
/// What the walker is doing; the field that leads him depends on it (a place alone does not tell out from back).
enum class Phase : std::uint8_t { out, round, stand, back };
/// Which sole: the order of the masks. User masks take the numbers from 0 on.
enum class Sole : std::uint8_t { man, woman, man_toe_slide, woman_toe_slide };

/// A footprint in numbers with units, before packing.
struct Step {
  glm::dvec2 body_m{0.0};        ///< the walker's F(t) = (x, y, theta); not packed
  double heading_rad = 0;        ///< theta; not packed
  glm::dvec2 foot_m{0.0};        ///< centre of the sole
  double foot_heading_rad = 0;
  double length_m = 0;           ///< of the step that led here; not packed. 0 for the first and for standing
  double side_m = 0, toe_out_rad = 0;  ///< d(t), phi(t); not packed
  double time_s = 0;             ///< since the first day's beginning
  double contact_s = 0;          ///< how long the foot stands
  double slip_m = 0;
  std::uint32_t number = 0;      ///< steps since the door
  Foot foot = Foot::left;
  Phase phase = Phase::out;
  bool toe_slide = false;
};

struct Footprint {
  double time_s = 0;
  std::uint32_t person = 0;      ///< number of the visit
  float x_m = 0, y_m = 0;
  std::uint16_t heading_turns = 0;   ///< 65536 = full turn
  std::uint16_t weight_dN = 0;       ///< tenths of a newton
  std::uint16_t sole_length_dmm = 0; ///< of the foot, tenths of a millimetre
  std::uint16_t contact_cs = 0;      ///< hundredths of a second
  std::uint16_t number = 0;          ///< steps since the door, at most 65535
  std::uint8_t slip_hmm = 0;         ///< half millimetres
  std::uint8_t code = 0;             ///< bit 0 foot, 1-3 sole, 4-5 behaviour, 6-7 phase

  double heading_rad() const;        ///< (-pi, pi]
  double weight_N() const { return 0.1 * weight_dN; }
  double foot_length_m() const { return 1e-4 * sole_length_dmm; }
  double contact_s() const { return 0.01 * contact_cs; }
  double slip_m() const { return 5e-4 * slip_hmm; }
  Foot foot() const { return Foot(code & 1); }
  int sole() const { return (code >> 1) & 7; }
  Behaviour behaviour() const { return Behaviour((code >> 4) & 3); }
  Phase phase() const { return Phase(code >> 6); }
  bool operator==(const Footprint&) const = default;
};
static_assert(sizeof(Footprint) == 32);

/// @param sole number of the mask, 0..7.
Footprint pack(const Step& step, std::uint32_t person, double weight_N, double foot_length_m, int sole,
               Behaviour behaviour);

/// Takes footprints in the order of the visits, some thousands at a time; valid during the call only.
using FootprintSink = std::function<void(std::span<const Footprint>)>;
/// Gives the next footprints, in the same order; an empty span at the end. Valid until the next call.
using FootprintSource = std::function<std::span<const Footprint>()>;

}  // namespace witherfield::floor
