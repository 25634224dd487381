// The description of a leaf scene's keys.
#pragma once
#include "sim/scene/key_visitor.hpp"
#include "sim/scene/scene.hpp"

namespace witherfield::scene {

/// A scene as it stands in the file.
struct LeafTables {
  std::string kind = "leaf";
  LeafScene scene;
  ObjectStill view;
};

void describe_leaf_scene(KeyVisitor& v, LeafTables& t);
void describe_wilt(KeyVisitor& v, leaf::WiltOptions& w);

}  // namespace witherfield::scene
