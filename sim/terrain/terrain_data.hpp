// What a Terrain holds. Private to this folder.
#pragma once
#include <memory>

#include "sim/terrain/surface.hpp"
#include "sim/terrain/terrain.hpp"

namespace witherfield::terrain {

struct Terrain::Data {
  std::unique_ptr<const Surface> surface;
  double horizontal = 1;  ///< scene metres per true metre
  double vertical = 1;    ///< the same for heights: horizontal * exaggeration
};

}  // namespace witherfield::terrain
