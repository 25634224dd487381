#include <fmt/format.h>

#include <algorithm>

#include "sim/scene/key_visitor.hpp"

namespace witherfield::scene {
namespace {

/// Damerau-Levenshtein (optimal string alignment): a swap of two letters, the commonest typing error, counts
/// once.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

}  // namespace

std::string number_text(double value) {
  return fmt::format("{}", value);
}

std::string limits_text(const Limits& limits) {
  const char* space = limits.unit.empty() ? "" : " ";
  if (limits.above_lo)
    return fmt::format("greater than {}, at most {}{}{}", limits.lo, limits.hi, space, limits.unit);
  return fmt::format("{}..{}{}{}", limits.lo, limits.hi, space, limits.unit);
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& known) {
  const auto distance = [&](const std::string& candidate) -> std::size_t {
    const bool unit_forgotten = candidate.rfind(std::string(name) + "_", 0) == 0;
    return unit_forgotten ? 1 : edit_distance(name, candidate);
  };
  const auto nearest =
      std::min_element(known.begin(), known.end(),
                       [&](const std::string& a, const std::string& b) { return distance(a) < distance(b); });
  return nearest == known.end() ? std::string() : *nearest;
}

std::string quoted_list(const Choices& names, std::string_view last_word) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? fmt::format(" {} ", last_word) : ", ";
    text += '"' + names[i] + '"';
  }
  return text;
}

}  // namespace witherfield::scene
