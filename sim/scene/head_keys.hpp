// Keys that scenes of every kind have.
#pragma once
#include "sim/scene/key_visitor.hpp"

namespace witherfield::scene {

/// `name` and `seed`, the first keys after `kind`.
void describe_head(KeyVisitor& v, std::string& name, std::uint64_t& seed);
/// The name of a picture must be fit for a file name.
void check_still_name(KeyVisitor& v, const std::string& name);

}  // namespace witherfield::scene
