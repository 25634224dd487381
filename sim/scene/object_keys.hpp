// Keys of pictures of single objects: fruit, leaves.
#pragma once
#include "sim/core/view.hpp"
#include "sim/scene/key_visitor.hpp"

namespace witherfield::scene {

/// What a kind of scene offers to its pictures.
struct ObjectChoices {
  Choices subjects;  ///< the first one is the default
  Choices organs;    ///< that `hide` may name
};

/// [view]: everything but the name. `frames`: what `wd` may name; empty = anything, the nearest is shown.
void describe_object_view(KeyVisitor& v, ObjectStill& still, const ObjectChoices& choices,
                          const std::vector<double>& frames);
/// [[still]] number `index`.
void describe_object_still(KeyVisitor& v, std::vector<ObjectStill>& stills, std::size_t index,
                           const ObjectChoices& choices, const std::vector<double>& frames);
/// Pictures of at most 240 pixels.
void shrink_stills(std::vector<ObjectStill>& stills);

}  // namespace witherfield::scene
