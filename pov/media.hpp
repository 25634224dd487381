// Pre-lit media: samples laid out for DF3 files, the boxes that hold them, and their text.
#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "pov/prelight.hpp"
#include "pov/scene_parts.hpp"

namespace witherfield::pov {

/// A block of samples for a DF3 and where they lie in the texel. Along z there is one layer below the ground
/// (a copy of the lowest one) and one empty layer above the grass; the box ends before the wrap of the
/// interpolation.
struct MediaBlock {
  int nx = 0, ny = 0, nz = 0;
  glm::dvec3 first_m{0.0};  ///< position of sample (0, 0, 0)
  double spacing_m = 1;
  glm::dvec3 box_lo_m{0.0}, box_hi_m{0.0};  ///< where the samples may be used
  std::size_t samples() const { return std::size_t(nx) * ny * nz; }
};

/// Density, and density times radiance per channel.
struct MediaSamples {
  std::vector<float> density;
  std::array<std::vector<float>, 3> emission;
  explicit MediaSamples(const MediaBlock& b) : density(b.samples(), 0.0f) {
    for (auto& e : emission) e.assign(b.samples(), 0.0f);
  }
  void add(std::size_t at, float rho, const glm::vec3& radiance) {
    density[at] += rho;
    for (int k = 0; k < 3; ++k) emission[std::size_t(k)][at] += rho * radiance[k];
  }
};

/// Block of a texel. @param folded true: the periodic tile, with a sample more on each side that repeats the
/// opposite one; false: all that there is, with an empty sample around it. (POV-Ray's densities are zero
/// outside their unit cube, so a DF3 must reach beyond the walls.)
MediaBlock media_block(const TexelGrid& grid, bool folded);
/// Adds all voxels of a texel to its block.
void add_texel(MediaSamples& samples, const MediaBlock& block, const TexelGrid& grid,
               const TexelPrelight& light, std::span<const glm::vec3> radiance, bool folded);

/// Parts of a block that hold grass, at most piece_samples samples wide and cropped in height: rays pay for
/// intervals only there and in proportion to their way; POV-Ray's limit of 254 intervals a box is never met.
struct MediaPiece {
  glm::dvec3 lo_m, hi_m;
  int intervals = 1;  ///< samples along the longest side
  int parity = 0;     ///< 0..7, another one than that of any piece next to it
};
std::vector<MediaPiece> find_pieces(const MediaBlock& block, std::span<const float> density,
                                    int piece_samples);

/// Declared densities as POV-Ray takes them ("density{NAME}"; several multiply) and their values at full scale.
struct MediaNames {
  std::string density, emission[3];
  double full_density = 1, full_emission = 1;
};
/// Writes the DF3s and their #declares. `declare_emission` keeps the density of `names` and replaces its
/// emission: one density serves many lights.
MediaNames declare_density(Text& scene, const SceneContext& c, const MediaBlock& block, MediaSamples& samples,
                           const std::string& name);
void declare_emission(Text& scene, const SceneContext& c, const MediaBlock& block, MediaSamples& samples,
                      const std::string& name, MediaNames& names);

/// For texels seen so close that a voxel is larger than a pixel: the kernel and the interpolation between voxels would
/// show as blur. Opacity runs from none to full between two densities (shares of the full scale), so that an edge is
/// as sharp as the interpolated density is smooth; radiance is kept apart and carried two voxels outward, so that the
/// edge does not darken.
struct SharpEdge {
  double none = 0.13, full = 0.55;
};
MediaNames declare_sharp(Text& scene, const SceneContext& c, const MediaBlock& block, const MediaSamples& samples,
                         const SharpEdge& edge, const std::string& name);

/// #declares of the intervals' quality; before any boxes.
std::string quality_text();
/// The boxes of one texel. @param overlap tiles, see box_overlap; @param depth_per_density optical depth of a
/// sample's spacing at density 1; @param factor on the emission; @param height_scale of the transform;
/// @param per_sample intervals for each sample along a box's longest side.
std::string boxes_text(const SceneContext& c, const MediaBlock& block, std::span<const MediaPiece> pieces,
                       double overlap, const MediaNames& names, double depth_per_density,
                       const glm::dvec3& factor, const std::string& transform, double height_scale = 1,
                       double per_sample = 1);

}  // namespace witherfield::pov
