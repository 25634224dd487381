// Parts that the mesh readers share: text line by line with places for error messages, numbers that do not
// depend on the locale, polygons to triangles.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "sim/core/surface.hpp"

namespace witherfield::vis {

/// The whole file. @throws IoFailure when it cannot be opened or read, InvalidInput when it is empty.
std::string read_whole_file(const std::filesystem::path& file);

/// At most 40 characters of a word of a file, without control characters, for messages.
std::string printable(std::string_view word);

/// Decimal number times 10^shift, correctly rounded (the shift moves the decimal point of the text). A
/// leading + is fine. False when `word` is no number.
bool parse_number(std::string_view word, double& value, int shift = 0);
bool parse_integer(std::string_view word, std::int64_t& value);
/// Appends the shortest decimal that gives `value` back, times 10^shift: parse_number with -shift returns it.
void append_number(std::string& text, double value, int shift = 0);
void append_number(std::string& text, float value);

/// Steps through lines and the words in them. A backslash at the end of a line continues it.
class TextScanner {
 public:
  /// `line` is the number of the first line of `text` in the file.
  TextScanner(const std::filesystem::path& file, std::string_view text, std::int64_t line = 1)
      : file_(file), rest_(text), next_line_(line) {}

  /// To the next line that has a word; what follows `comment` in it (0: no comments) is left out.
  /// False at the end of the text.
  bool next_line(char comment = '#');
  /// As next_line; at the end it fails: "file ends where WHAT is expected".
  void need_line(const std::string& what, char comment = '#');
  /// Next word of the line; empty at its end.
  std::string_view word();
  /// The words that are left.
  std::string_view rest_of_line() const { return line_; }
  /// Next word as a finite number. `what` it is stands in the message of a failure.
  double number(const char* what, int shift = 0);
  std::int64_t integer(const char* what);
  std::int64_t line() const { return this_line_; }

  /// @throws InvalidInput "cannot read FILE: line N: WHAT".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::filesystem::path file_;
  std::string_view rest_, line_;
  std::int64_t next_line_, this_line_ = 0;
};

/// @throws InvalidInput "cannot read FILE: WHAT".
[[noreturn]] void fail_reading(const std::filesystem::path& file, const std::string& what);

/// Triangles (c0, c1, c2), (c0, c2, c3), ... @pre at least three corners.
void add_fan(Surface& surface, std::span<const int> corners);

/// Unit normal of what a file says; (0, 0, 0) stays. What is unit to float precision keeps its bits.
glm::dvec3 unit_normal(const glm::dvec3& n);

}  // namespace witherfield::vis
