// POV-Ray scenes of single objects (fruit, leaves) for the stills of a run.
#pragma once
#include <functional>
#include <vector>

#include "cli/run_folder.hpp"
#include "cli/run_record.hpp"
#include "pov/object_scene.hpp"
#include "sim/core/surface.hpp"
#include "sim/core/view.hpp"

namespace witherfield::cli {

class Console;

/// The surfaces that a still shows side by side, from the left.
using ObjectsOf = std::function<std::vector<Surface>(const ObjectStill&)>;

/// How organs look, by organ_id, and all the others.
struct ObjectLooks {
  std::map<int, pov::ObjectLook> by_organ;
  pov::ObjectLook other;
  bool common_ground = false;  ///< objects side by side keep their heights; else each stands on the ground
};

/// Writes pov/<still>_object.pov for every still and records it. @throws IoFailure, InvalidInput,
/// Interrupted.
void write_object_stills(const RunFolder& folder, RunRecord& record, const std::vector<ObjectStill>& stills,
                         const ObjectLooks& looks, const ObjectsOf& objects_of, Console& console);

}  // namespace witherfield::cli
