// A leaf that loses more water than it gets: water, then shape, moment after moment.
#pragma once
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sim/core/progress.hpp"
#include "sim/core/surface.hpp"
#include "sim/leaf/leaf_water.hpp"
#include "sim/leaf/wilt_body.hpp"
#include "sim/leaf/wilt_options.hpp"

namespace witherfield::leaf {

/// One key frame. Pointers are valid during the call only.
struct WiltFrame {
  int index = 0;
  double hours = 0;
  /// The blade's vertices in their order, then the petiole as a tube. Normals; uv when the body has them; fields water,
  /// chlorophyll_ug_cm2, stress_von_mises_MPa, strain_area, vein, displacement_m, diffuse, organ_id (0 blade, 1 petiole).
  const Surface* surface = nullptr;
  const std::vector<glm::dvec3>* petiole_m = nullptr;  ///< centre line, stem first; empty when there is none
  double water = 1;                 ///< mean of the blade
  double area_change = 0;           ///< of the blade against the natural pose, relative
  double midrib_change = 0;         ///< of the first vein's length, relative
  double petiole_drop_deg = 0;      ///< by how much the petiole's chord has turned down
  double tip_drop_deg = 0;          ///< the same of its end
  double drop_m = 0;                ///< by how much the blade's centre of mass has sunk
};
using WiltSink = std::function<void(const WiltFrame&)>;

struct WiltReport {
  WaterBalance balance;
  double balance_error = 0;         ///< relative, over the whole run
  double midrib_change_max = 0;     ///< largest |midrib_change| of all frames
  double area_change_last = 0;
  int solves = 0, iterations = 0;   ///< equilibria, Newton steps
  int unconverged = 0;              ///< equilibria that ended at max_iterations
  double residual_max = 0;          ///< see RelaxReport
  bool energy_fell = true;          ///< in every step of every equilibrium
  int touching_max = 0;             ///< pairs of vertices that kept each other apart
  struct Stage { std::string name; double seconds; };
  std::vector<Stage> stages;        ///< wall clock: set-up, water, shape
};

/// Runs from full turgor at hour 0; calls `sink` for each key frame. @throws InvalidInput, SolverFailure.
WiltReport simulate_wilt(const WiltBody& body, const WiltOptions& options, const WiltSink& sink, const Progress& progress = {});

}  // namespace witherfield::leaf
