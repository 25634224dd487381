#include "sim/scene/head_keys.hpp"

#include <algorithm>

namespace witherfield::scene {
namespace {

/// Text that starts with a character of `first` and goes on with those of `rest`; a-z style ranges are
/// understood.
struct Pattern {
  std::string_view first, rest;
};

bool in_class(char c, std::string_view characters) {
  for (std::size_t i = 0; i < characters.size(); ++i) {
    if (i + 2 < characters.size() && characters[i + 1] == '-') {
      if (c >= characters[i] && c <= characters[i + 2]) return true;
      i += 2;
    } else if (c == characters[i]) {
      return true;
    }
  }
  return false;
}

bool matches(const std::string& text, const Pattern& p) {
  return !text.empty() && in_class(text[0], p.first) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return in_class(c, p.rest); });
}

}  // namespace

void describe_head(KeyVisitor& v, std::string& name, std::uint64_t& seed) {
  v.text({"name", "Name of the run (default: this file's name); its files go to out/<name>"}, name, {});
  v.check("name", name.empty() || matches(name, {"A-Za-z0-9_", "A-Za-z0-9_.-"}), [] {
    return "a name consists of letters, digits, '_', '.' and '-', and starts with a letter, digit or '_'";
  });
  v.seed({"seed", "Random numbers: the same seed gives the same run, whatever the number of threads"}, seed);
}

void check_still_name(KeyVisitor& v, const std::string& name) {
  v.check("name", matches(name, {"a-z0-9_", "a-z0-9_"}),
          [] { return "a still needs a name of letters a-z, digits and _"; });
}

}  // namespace witherfield::scene
