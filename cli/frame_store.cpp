#include "cli/frame_store.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/errors.hpp"
#include "sim/grass/mingle.hpp"

namespace witherfield::cli {
namespace {

/// A grid can be halved, and then folded, as long as bricks and margins stay whole (mingle.hpp).
bool can_halve(const GridShape& s) {
  return s.nx % 8 == 0 && s.ny % 8 == 0 && s.nz % 8 == 0 && s.margin % 2 == 0;
}
bool can_fold(const GridShape& s) {
  return (s.nx - 2 * s.margin) % 4 == 0 && (s.ny - 2 * s.margin) % 4 == 0;
}

}  // namespace

void FrameStore::want(double wd, int finest_lod, bool blades) {
  Wanted& w = wanted_[wd];
  w.finest_lod = std::min(w.finest_lod, finest_lod);
  w.blades = w.blades || blades;
}

std::map<double, FrameStore::Wanted>::const_iterator FrameStore::find(double wd) const {
  return std::find_if(wanted_.begin(), wanted_.end(), [&](const auto& w) { return std::abs(w.first - wd) < 1e-9; });
}

bool FrameStore::wants_blades(double wd) const {
  const auto wanted = find(wd);
  return wanted != wanted_.end() && wanted->second.blades;
}

void FrameStore::take(const grass::GrassFrame& frame) {
  const auto wanted = find(frame.wd);
  if (wanted == wanted_.end()) return;
  auto kept = std::make_unique<Kept>();
  kept->lod[0] = *frame.texel;
  int coarsest = 0;
  while (coarsest < 3 && can_halve(kept->lod[coarsest].shape())) {
    kept->lod[coarsest + 1] = grass::half_resolution(kept->lod[coarsest]);
    ++coarsest;
  }
  const int finest = std::min(wanted->second.finest_lod, coarsest);
  for (int l = 0; l <= coarsest; ++l) {
    if (l < finest) {
      kept->lod[l] = TexelGrid();
      continue;
    }
    kept->view.lod[l] = &kept->lod[l];
    if (!can_fold(kept->lod[l].shape())) continue;
    kept->tile[l] = grass::fold_to_tile(kept->lod[l]);
    kept->view.tile[l] = &kept->tile[l];
  }
  if (wanted->second.blades) kept->blades = *frame.blades;
  kept->view.blades = wanted->second.blades ? &kept->blades : nullptr;
  kept_[{wanted->first, frame.variant}] = std::move(kept);
}

std::vector<pov::VariantFrame> FrameStore::frames(double wd, int variants) const {
  std::vector<pov::VariantFrame> out;
  for (int v = 0; v < variants; ++v) {
    const auto kept = kept_.find({wd, v});
    if (kept == kept_.end())
      throw SolverFailure("FrameStore: key frame wd " + std::to_string(wd) + " of variant " +
                          std::to_string(v) + " was never simulated");
    out.push_back(kept->second->view);
  }
  return out;
}

}  // namespace witherfield::cli
