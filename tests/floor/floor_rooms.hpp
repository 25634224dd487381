// The three example rooms: fig. 3 (patrol) and fig. 4 (round trips) of Su et al. 1998, and a flight of stone stairs.
#pragma once
#include "sim/floor/options.hpp"

namespace witherfield::floor {

inline Obstacle box_obstacle(const char* name, double x0, double y0, double x1, double y1) {
  return {name, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
}

/// 9 m x 9 m, one door, pictures on all walls, a bench in the middle; everybody goes round.
inline FloorOptions patrol_gallery() {
  FloorOptions o;
  o.room.outline_m = {{0, 0}, {9, 0}, {9, 9}, {0, 9}};
  o.room.doors = {{"entrance", {3.8, 0}, {5.2, 0}}};
  o.room.obstacles = {box_obstacle("bench", 3.7, 4.2, 5.3, 4.8)};
  for (const double at : {2.0, 4.5, 7.0}) {
    o.room.pictures.push_back({"left", {0, at}});
    o.room.pictures.push_back({"right", {9, at}});
    o.room.pictures.push_back({"back", {at, 9}});
  }
  o.room.pictures.push_back({"front left", {1.6, 0}});
  o.room.pictures.push_back({"front right", {7.4, 0}});
  o.crowd.visits = 100000;
  o.crowd.days = 7300;
  o.crowd.visits_each = 10;
  return o;
}

/// 12 m x 7 m, one door in the short wall, six desks to work at, a cupboard, and a printer.
inline FloorOptions office_round_trips() {
  FloorOptions o;
  o.room.outline_m = {{0, 0}, {12, 0}, {12, 7}, {0, 7}};
  o.room.doors = {{"door", {0, 3.0}, {0, 4.0}}};
  for (const double x : {3.2, 6.3, 9.4}) {
    o.room.obstacles.push_back(box_obstacle("desk at the window", x, 5.6, x + 1.6, 6.4));
    o.room.places.push_back({"chair at the window", {x + 0.8, 5.25}, 90, 1.0});
    o.room.obstacles.push_back(box_obstacle("desk at the wall", x, 0.6, x + 1.6, 1.4));
    o.room.places.push_back({"chair at the wall", {x + 0.8, 1.75}, -90, 1.0});
  }
  o.room.obstacles.push_back(box_obstacle("table", 5.4, 3.1, 7.2, 4.0));
  o.room.obstacles.push_back(box_obstacle("cupboard", 11.5, 2.5, 12, 4.5));
  o.room.places.push_back({"printer", {11.15, 4.2}, 0, 1.5, 2});
  o.crowd.patrol_share = 0;
  o.crowd.round_trip_share = 1;
  o.crowd.visits = 100000;
  o.crowd.days = 7300;
  o.crowd.visits_each = 10;
  return o;
}

/// Fourteen limestone steps out of doors, five hundred years, a thousand people a day.
inline FloorOptions stone_stairs() {
  FloorOptions o;
  o.stairs = StairOptions{.treads = 14};
  o.material = material_preset("limestone");
  o.material.pattern.laying = Laying::seamless;
  o.material.layers[0].wear_coefficient = 1e-3;  // sand under wet soles: the upper end of what is known
  o.crowd.visits = 100000;
  o.crowd.days = 500 * 365.25;
  o.crowd.visits_each = 1800;
  o.footprints.pixels_per_m = 200;
  return o;
}

}  // namespace witherfield::floor
