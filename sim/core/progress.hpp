// Long work reports how far it is; only the command line prints.
#pragma once
#include <functional>
#include <string_view>

namespace witherfield {
/// Called with the stage's name and the fraction done in [0, 1]. May be empty.
using Progress = std::function<void(std::string_view stage, double fraction)>;
}  // namespace witherfield
