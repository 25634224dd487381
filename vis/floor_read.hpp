// Floors back from the .vti files of a run.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sim/core/floor_field.hpp"

namespace witherfield::vis {

/// What write_floor_vti wrote (vis/writers.hpp): the named channels only.
/// @throws IoFailure (missing, damaged, no such array).
FloorField read_floor_vti(const std::filesystem::path& file, const std::vector<std::string>& channels);

}  // namespace witherfield::vis
