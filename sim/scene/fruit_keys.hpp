// The description of a fruit scene's keys.
#pragma once
#include "sim/scene/key_visitor.hpp"
#include "sim/scene/scene.hpp"

namespace witherfield::scene {

/// A scene as it stands in the file.
struct FruitTables {
  std::string kind = "fruit";
  FruitScene scene;
  ObjectStill view;
};

void describe_fruit_scene(KeyVisitor& v, FruitTables& t);
/// [output] of single objects.
void describe_object_output(KeyVisitor& v, ObjectOutput& o);

}  // namespace witherfield::scene
