// The described keys as text: a commented TOML scene, JSON, or the bare list of names.
#pragma once
#include "sim/scene/key_visitor.hpp"

namespace witherfield::scene {

/// Every key with its meaning, range, unit and present value. Optional and repeated tables are commented out.
std::string commented_toml(const KeyVisitor::Body& describe);
/// All present values as a TOML scene without comments: it loads back to the same values.
std::string values_toml(const KeyVisitor::Body& describe);
/// All present values. Keys that are not set are left out.
std::string values_json(const KeyVisitor::Body& describe, const std::vector<std::string>& leave_out);
/// Paths of all keys: "seed", "season.length_days", "mingle.count" ...
std::vector<std::string> key_paths(const KeyVisitor::Body& describe);

}  // namespace witherfield::scene
