// A built leaf: flat blade, natural pose, veins, petiole, and the stages in which it was made.
// Frame: the petiole ends at the origin, the main vein of the flat leaf runs along +x, the left half is +y, the upper
// side looks to +z (measured leaves: as near to that as their main vein and plane allow).
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sim/core/surface.hpp"
#include "sim/leaf/options.hpp"
#include "sim/leaf/outline.hpp"
#include "sim/leaf/wilt_body.hpp"

namespace witherfield::leaf {

/// A vein as a curve on the flat blade.
struct Vein {
  int order = 1;                    ///< 1 main veins (the midrib is vein 0), 2 side veins, 3 net
  int parent = -1;                  ///< number of the vein it leaves, -1 = the petiole
  std::vector<glm::dvec2> line_m;   ///< from its origin outwards
  double width_base_m = 0, width_tip_m = 0;
};

/// One step of the construction (Miao et al., fig. 5), as it can be shown: points, curves or triangles.
struct Stage {
  std::string name;                     ///< points, splines, mesh, subdivided, repaired
  Surface surface;                      ///< without triangles for points and splines
  std::vector<std::vector<int>> lines;  ///< left, right, midrib as chains of vertices (points, splines)
};

struct Petiole {
  std::vector<glm::dvec3> line_m;  ///< from the stem to the blade's base (the origin); empty = none
  double radius_stem_m = 0, radius_blade_m = 0;
};

struct LeafModel {
  Surface flat;                 ///< at rest in the plane z = 0, with uv
  Surface natural;              ///< same vertices and triangles in the natural pose: what is edited and what wilts
  std::vector<Vein> veins;      ///< vein 0 = midrib
  std::vector<double> vein;     ///< per vertex, 0 blade .. 1 middle of a main vein
  std::vector<double> vein_width_m;  ///< per vertex: width of the widest main or side vein that runs there, 0 elsewhere
  std::vector<int> midrib;      ///< vertices on the midrib, base to tip
  std::vector<int> base;        ///< vertices where the petiole ends (held in edits and wilting)
  std::vector<int> border;      ///< vertices of the margin, in order, counter-clockwise from above
  Petiole petiole;
  std::vector<Stage> stages;
  double area_m2 = 0;           ///< of the blade as outlined: flat (veins) or as measured, without relief (what a scanner of a pressed leaf sees)
  double natural_area_m2 = 0;   ///< with waves and relief
  double area_error = 0;        ///< (area_m2 - reference) / reference; 0 when no reference is given
  int ears_split = 0;           ///< triangles with two border edges that were repaired
  double main_vein_m = 0;       ///< length of the midrib on the flat blade
  double net_spacing_m = 0;     ///< size of the cells of the net; 0 = none
  double chlorophyll_ug_cm2 = 42;
};

/// What the caller read from files.
struct LeafInput {
  OutlinePoints points;  ///< source = points; source = veins: an outline by hand instead of the veins' own, in the leaf's frame
  Surface mesh;
};

/// @throws InvalidInput with the reason when options or input cannot make a leaf.
LeafModel build_leaf(const LeafOptions& options, const LeafInput& input = {});

/// The blade at `position_m` (one per vertex of the model) with normals, uv and the fields vein, strain_area,
/// displacement_m (against `natural`), diffuse (upper side, linear sRGB).
Surface to_surface(const LeafModel& model, const std::vector<glm::dvec3>& position_m);
/// The natural pose.
Surface to_surface(const LeafModel& model);

/// What the wilting simulation takes: the natural pose, or another one of the same vertices (an edited leaf).
WiltBody wilt_body(const LeafModel& model);
WiltBody wilt_body(const LeafModel& model, const std::vector<glm::dvec3>& position_m);

/// The petiole as a closed tube; its last ring lies under the blade's base. Empty when there is none.
Surface petiole_surface(const Petiole& petiole, int sides = 12);

/// Veins and fine relief as pictures over uv in 0..1, rows from v = 0 upwards: finer than any mesh.
struct VeinMap {
  int pixels = 0;
  std::vector<float> vein;    ///< 0..1, all orders
  std::vector<float> height;  ///< 0..1: 0 in the veins, 1 in the middle of the cells of the net
};
VeinMap rasterize_veins(const LeafModel& model, int pixels);

}  // namespace witherfield::leaf
