#include "vis/mesh_text.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/geometric.hpp>
#include <memory>

#include "sim/core/errors.hpp"

namespace witherfield::vis {
namespace {

constexpr std::string_view kBlank = " \t\r\v\f\n\\";

bool parse_plain(std::string_view word, double& value) {
  const char* end = word.data() + word.size();
  const auto [at, error] = std::from_chars(word.data(), end, value);
  if (at != end || word.empty()) return false;
  if (error == std::errc::result_out_of_range) {  // too small is 0, too large is infinite
    const auto e = word.find_last_of("eE");
    const bool small = e != std::string_view::npos && e + 1 < word.size() && word[e + 1] == '-';
    value = small ? 0.0 : HUGE_VAL;
    return true;
  }
  return error == std::errc();
}

}  // namespace

std::string read_whole_file(const std::filesystem::path& file) {
  const auto fail = [&](int error) {
    throw IoFailure(fmt::format("cannot read '{}': {}", file.string(), std::strerror(error)));
  };
  if (std::filesystem::is_directory(file)) fail(EISDIR);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), &std::fclose);
  if (!stream) fail(errno);
  std::string content;
  std::size_t used = 0;
  std::error_code unknown;
  const auto size = std::filesystem::file_size(file, unknown);
  content.resize((unknown ? 0 : std::size_t(size)) + 1);
  for (std::size_t got;
       (got = std::fread(content.data() + used, 1, content.size() - used, stream.get())) > 0;) {
    used += got;
    if (used == content.size()) content.resize(2 * used);
  }
  if (std::ferror(stream.get())) fail(errno);
  content.resize(used);
  if (content.empty()) fail_reading(file, "the file is empty");
  return content;
}

std::string printable(std::string_view word) {
  std::string out;
  for (const char c : word.substr(0, 40)) out += c >= ' ' && c <= '~' ? c : '?';
  return word.size() > 40 ? out + "..." : out;
}

bool parse_number(std::string_view word, double& value, int shift) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  if (shift == 0) return parse_plain(word, value);
  const auto e = word.find_first_of("eE");
  std::int64_t exponent = 0;
  if (e != std::string_view::npos && !parse_integer(word.substr(e + 1), exponent)) return false;
  std::array<char, 128> text;
  const std::string_view digits = word.substr(0, e);
  if (digits.size() > 100 ||
      std::abs(exponent) > 9999) {  // nobody's shortest decimal: rounding twice is fine
    const bool good = parse_plain(word, value);
    value *= std::pow(10.0, shift);
    return good;
  }
  char* end = std::copy(digits.begin(), digits.end(), text.begin());
  *end++ = 'e';
  end = std::to_chars(end, text.data() + text.size(), exponent + shift).ptr;
  return parse_plain({text.data(), std::size_t(end - text.data())}, value);
}

bool parse_integer(std::string_view word, std::int64_t& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto [at, error] = std::from_chars(word.data(), end, value);
  return error == std::errc() && at == end && !word.empty();
}

void append_number(std::string& text, float value) {
  std::array<char, 32> buffer;
  text.append(buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr);
}

void append_number(std::string& text, double value, int shift) {
  std::array<char, 40> buffer;
  if (shift == 0) {
    text.append(buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr);
    return;
  }
  // d.ddde+xx with the point moved
  const char* end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::scientific).ptr;
  std::string_view word(buffer.data(), std::size_t(end - buffer.data()));
  const auto e = word.find('e');
  std::int64_t exponent = 0;
  if (e == std::string_view::npos || !parse_integer(word.substr(e + 1), exponent)) {
    text += word;  // nan, inf
    return;
  }
  exponent += shift;
  std::string digits;
  for (const char c : word.substr(0, e))
    if (c >= '0' && c <= '9') digits += c;
  if (word[0] == '-') text += '-';
  if (digits == "0") {
    text += '0';
  } else if (exponent < -5 || exponent > 14) {
    text += digits[0];
    if (digits.size() > 1) text.append(".").append(digits, 1);
    text.append("e").append(std::to_string(exponent));
  } else if (exponent < 0) {
    text.append("0.").append(std::size_t(-exponent - 1), '0').append(digits);
  } else {
    const std::size_t whole = std::size_t(exponent) + 1;
    if (digits.size() < whole) digits.resize(whole, '0');
    text.append(digits, 0, whole);
    if (digits.size() > whole) text.append(".").append(digits, whole);
  }
}

bool TextScanner::next_line(char comment) {
  while (!rest_.empty()) {
    this_line_ = next_line_;
    std::size_t end = 0;
    for (;;) {
      end = rest_.find('\n', end);
      ++next_line_;
      if (end == std::string_view::npos) break;
      const std::size_t last = end > 0 && rest_[end - 1] == '\r' ? end - 1 : end;
      if (last == 0 || rest_[last - 1] != '\\') break;
      ++end;
    }
    line_ = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
    if (comment) line_ = line_.substr(0, line_.find(comment));
    if (const auto first = line_.find_first_not_of(kBlank); first != std::string_view::npos) {
      line_.remove_prefix(first);
      return true;
    }
  }
  return false;
}

void TextScanner::need_line(const std::string& what, char comment) {
  if (next_line(comment)) return;
  fail_reading(file_, fmt::format("the file ends after line {} where {} is expected", next_line_ - 1, what));
}

std::string_view TextScanner::word() {
  const auto first = line_.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  const auto end = line_.find_first_of(kBlank, first);
  const std::string_view word = line_.substr(first, end == std::string_view::npos ? end : end - first);
  line_ = end == std::string_view::npos ? std::string_view() : line_.substr(end);
  return word;
}

double TextScanner::number(const char* what, int shift) {
  const std::string_view w = word();
  double value = 0;
  if (w.empty()) fail(fmt::format("the line ends where {} is expected", what));
  if (!parse_number(w, value, shift)) fail(fmt::format("{} '{}' is not a number", what, printable(w)));
  if (!std::isfinite(value)) fail(fmt::format("{} '{}' is not finite", what, printable(w)));
  return value;
}

std::int64_t TextScanner::integer(const char* what) {
  const std::string_view w = word();
  std::int64_t value = 0;
  if (w.empty()) fail(fmt::format("the line ends where {} is expected", what));
  if (!parse_integer(w, value)) fail(fmt::format("{} '{}' is not a whole number", what, printable(w)));
  return value;
}

void TextScanner::fail(const std::string& what) const {
  fail_reading(file_, fmt::format("line {}: {}", this_line_, what));
}

void fail_reading(const std::filesystem::path& file, const std::string& what) {
  throw InvalidInput(fmt::format("cannot read '{}': {}", file.string(), what));
}

void add_fan(Surface& surface, std::span<const int> corners) {
  for (std::size_t k = 2; k < corners.size(); ++k)
    surface.triangles.push_back({corners[0], corners[k - 1], corners[k]});
}

glm::dvec3 unit_normal(const glm::dvec3& n) {
  const double length = glm::length(n);
  return length > 0 && std::abs(length - 1) > 1e-6 ? n / length : n;
}

}  // namespace witherfield::vis
