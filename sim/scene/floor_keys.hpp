// The description of a floor scene's keys.
#pragma once
#include "sim/scene/key_visitor.hpp"
#include "sim/scene/scene.hpp"

namespace witherfield::scene {

/// A scene as it stands in the file.
struct FloorTables {
  std::string kind = "floor";
  FloorScene scene;
  RoomStill view;
};

void describe_floor_scene(KeyVisitor& v, FloorTables& t);
void describe_crowd(KeyVisitor& v, floor::FloorOptions& o);
void describe_gait(KeyVisitor& v, floor::GaitOptions& g);
void describe_material(KeyVisitor& v, floor::MaterialOptions& m);
/// Four numbers: mean, standard deviation, least, greatest.
void spread(KeyVisitor& v, const Key& key, floor::Spread& s, const Limits& limits);

}  // namespace witherfield::scene
