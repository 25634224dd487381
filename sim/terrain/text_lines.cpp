#include "sim/terrain/text_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/errors.hpp"

namespace witherfield::terrain {

Words split(std::string_view line) {
  Words words;
  constexpr const char* blank = " \t\r";
  for (std::size_t at = line.find_first_not_of(blank); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blank, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(blank, end);
  }
  return words;
}

TextLines::TextLines(const std::string& file) : file_(file), in_(file, std::ios::binary) {
  if (!in_) throw IoFailure(fmt::format("terrain.mesh: cannot open '{}'", file));
}

bool TextLines::next() {
  if (!std::getline(in_, text_)) return false;
  ++number_;
  return true;
}

void TextLines::malformed(const std::string& what) const {
  throw IoFailure(fmt::format("terrain.mesh: {}:{}: {}", file_, number_, what));
}

void TextLines::invalid(const std::string& what) const {
  throw InvalidInput(fmt::format("terrain.mesh: {}:{}: {}", file_, number_, what));
}

double TextLines::coordinate(std::string_view word) const {
  const auto value = parse<double>(word);
  if (!value) malformed(fmt::format("'{}' is not a number", word));
  if (!std::isfinite(*value)) invalid(fmt::format("a coordinate is '{}'; it must be finite", word));
  return *value;
}

void TextLines::require_distinct(std::vector<std::int64_t> vertices) const {
  std::sort(vertices.begin(), vertices.end());
  const auto twice = std::adjacent_find(vertices.begin(), vertices.end());
  if (twice != vertices.end()) invalid(fmt::format("the face names vertex {} twice", *twice));
}

}  // namespace witherfield::terrain
