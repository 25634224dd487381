// Tracks of real or simulated pedestrians as footprints: positions over time from the text files of JuPedSim and Vadere,
// or from CSV.
#pragma once
#include <string_view>
#include <vector>

#include "sim/floor/footprint.hpp"

namespace witherfield::floor {

struct TrackPoint {
  double time_s = 0;
  glm::dvec2 at_m{0.0};
};
struct Track {
  std::int64_t person = 0;
  std::vector<TrackPoint> points;  ///< in time
};

enum class TrackFormat {
  guess,     ///< by the header
  csv,       ///< person,time_s,x_m,y_m in this order; a header line may stand first
  jupedsim,  ///< comments with "# framerate: 8", then columns id frame x y [z ...]
  vadere,    ///< header "pedestrianId simTime endTime startX-PID1 startY-PID1 endX-PID1 endY-PID1 ...", or the older
             ///< "timeStep pedestrianId x-PID1 y-PID1 ..."
};

/// Tracks by person, ascending. @throws InvalidInput naming `source`, the line and what is wrong with it.
std::vector<Track> parse_tracks(std::string_view text, TrackFormat format = TrackFormat::guess,
                                std::string_view source = "tracks");

/// Sets feet along the tracks: steps and feet drawn as for our own walkers, the speed taken from the track. Every track
/// is a visit; its number is its place in `tracks` (+ first_visit). Where somebody stands for more than half a second,
/// both feet do.
void footprints_of(const std::vector<Track>& tracks, const FloorOptions& options, const FootprintSink& sink,
                   std::int64_t first_visit = 0);

}  // namespace witherfield::floor
