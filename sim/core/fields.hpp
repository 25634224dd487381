// The declared fields: every array that is ever written has its name, unit and component count here.
// The names are the contract with users' ParaView states (docs/formats.md); an unknown name throws.
#pragma once
#include <span>
#include <string_view>

namespace witherfield {

struct FieldSpec {
  std::string_view name;   ///< array name as written to files; carries the unit where the unit is not 1
  std::string_view unit;   ///< "1" for dimensionless
  int components;          ///< 1, 2 or 3
  double lo, hi;           ///< physical bounds, used by checks and as last resort for colour scales
  std::string_view title;  ///< for colour bars, e.g. "Water content"
};

/// All declared fields, in a fixed order.
std::span<const FieldSpec> all_fields();

/// @throws InvalidInput naming the unknown field and the nearest declared one.
const FieldSpec& field_spec(std::string_view name);

}  // namespace witherfield
