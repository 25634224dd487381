// Keeps of the key frames what the stills show, and no more: the LOD chain from the finest level used on,
// folded tiles, blades.
#pragma once
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "pov/scene_writer.hpp"
#include "sim/grass/simulate.hpp"

namespace witherfield::cli {

class FrameStore {
 public:
  /// Asks for the key frame at `wd`. @param finest_lod the finest level of detail that will be drawn, 0..3.
  void want(double wd, int finest_lod, bool blades);
  /// Was the frame at `wd` asked for, with its blades?
  bool wants_blades(double wd) const;
  /// Keeps the frame if it was asked for.
  void take(const grass::GrassFrame& frame);
  /// Pointers into the store. @pre all variants of that wd were taken.
  std::vector<pov::VariantFrame> frames(double wd, int variants) const;

 private:
  struct Wanted {
    int finest_lod = 3;
    bool blades = false;
  };
  struct Kept {
    TexelGrid lod[4], tile[4];
    BladeRibbons blades;
    pov::VariantFrame view;
  };
  std::map<double, Wanted>::const_iterator find(double wd) const;

  std::map<double, Wanted> wanted_;
  std::map<std::pair<double, int>, std::unique_ptr<Kept>> kept_;  // (wd, variant)
};

}  // namespace witherfield::cli
