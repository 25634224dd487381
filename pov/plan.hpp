// What of a run a picture shows and how finely: the instances inside the view, their level of detail, the
// meadow around the terrain's cut borders, and boxes for the media that never share a face.
#pragma once
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "pov/scene_writer.hpp"

namespace witherfield::pov {

/// POV-Ray ignores hits nearer than 1e-4 units and loses grazing ones below 1e-3: a tile is made this many
/// units wide.
inline constexpr double kUnitsPerTile = 10.0;

/// The eye as a pinhole, for culling and for pixel sizes.
struct Eye {
  glm::dvec3 position_m, forward, right, up;
  double tan_x, tan_y;    ///< half extents of the picture at distance 1
  double pixels_per_rad;  ///< at the middle of the picture
  explicit Eye(const Still& still);
  /// Does a sphere show, or could what is within `reach_m` of it?
  bool sees(const glm::dvec3& centre_m, double radius_m) const;
};

/// How a texel's media are boxed: near ones are merged with what leans in from their neighbours, cell by
/// cell; farther ones keep their own overhanging blades in boxes that overlap; where a tile is a few pixels
/// wide the folded tile will do.
enum class Boxing { merged, overhanging, folded };

/// One texel that is drawn. `at.lod` is what the picture uses.
struct Stand {
  TexelInstance at;
  Boxing boxing = Boxing::folded;
  double distance_m = 0;
  int orientation() const { return at.quarter_turns + (at.mirrored ? 4 : 0); }
};

/// The ground around a placement: height of the extended border, falling to a level plain.
class Surroundings {
 public:
  Surroundings(const Placement& placement);
  double height_m(double x_m, double y_m) const;  ///< beyond the placement; on its border the terrain's own
  double plain_m() const { return plain_m_; }
  double reach_m() const { return reach_m_; }  ///< where the plain begins
  int cells() const { return cells_; }         ///< width of the ring of extra texels
  double low_x_m() const { return x0_; }
  double low_y_m() const { return y0_; }
  double high_x_m() const { return x1_; }
  double high_y_m() const { return y1_; }

 private:
  const Placement* placement_;
  double x0_, y0_, x1_, y1_, plain_m_, reach_m_;
  int cells_;
};

struct StandPlan {
  std::vector<Stand> stands;                           ///< what is drawn
  std::map<std::pair<int, int>, TexelInstance> cells;  ///< all texels there are, by cell
};

/// Instances to draw: those of the placement in view (LOD never finer than what the picture can show), and a
/// ring of texels around it so that the hill does not end in a cut. @param margin_m how far outside the view
/// an instance still matters.
StandPlan plan_stands(const SceneInput& input, const Surroundings* around, double margin_m);

/// Where boxes of media meet they overlap a little: a gap shows as a dark line when seen edge-on. And no two
/// faces of boxes that overlap may coincide, because POV-Ray enters and leaves a box by taking turns and
/// overlooks a face within 1e-4 units of another: then whole boxes are lost, or are never left. So every box
/// reaches over its walls by a length of its own among its neighbours: kCellOverlaps lengths for the cells (a
/// 2 x 2 pattern) times eight for the pieces of one cell's texel (2 x 2 x 2). In tiles, of kUnitsPerTile
/// units.
inline constexpr double kOverlapStep = 2e-5;
inline constexpr int kCellOverlaps = 4;
/// The overlap of piece 0 of a cell; piece p has kCellOverlaps * kOverlapStep * p more.
double box_overlap(int cell_i, int cell_j);

/// Slopes and sun visibility as the light sees them: means over a cell and its neighbours, so that tiles do
/// not show as facets.
TexelInstance smoothed(const StandPlan& plan, const TexelInstance& t);

/// Direction or position of the world in the frame of a texel instance (inverse of its mirror and quarter
/// turns).
glm::dvec3 to_local_direction(const TexelInstance& t, const glm::dvec3& world);
/// POV-Ray's "matrix<...>" that takes texel coordinates (flipped, in units) to the world.
std::string instance_matrix(const TexelInstance& t, double tile_m, double unit);

}  // namespace witherfield::pov
