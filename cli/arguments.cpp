#include <charconv>

#include "cli/commands.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::cli {
namespace {

template <class T>
bool parse_pair(const std::string& text, char separator, T& a, T& b) {
  const char *begin = text.data(), *end = begin + text.size();
  const auto first = std::from_chars(begin, end, a);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != separator) return false;
  const auto second = std::from_chars(first.ptr + 1, end, b);
  return second.ec == std::errc() && second.ptr == end;
}

}  // namespace

std::pair<int, int> parse_size(const std::string& text) {
  int width = 0, height = 0;
  if (!parse_pair(text, 'x', width, height) || width < 16 || height < 16 || width > 16384 || height > 16384)
    throw InvalidInput("--size " + text + ": must be WIDTHxHEIGHT, each 16..16384 pixels, e.g. 1280x720");
  return {width, height};
}

std::pair<double, double> parse_range(const std::string& text) {
  double lo = 0, hi = 0;
  if (!parse_pair(text, ',', lo, hi) || !(lo < hi))
    throw InvalidInput("--range " + text + ": must be LO,HI with LO < HI, e.g. 0.2,0.9");
  return {lo, hi};
}

}  // namespace witherfield::cli
