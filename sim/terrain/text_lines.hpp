// Reading a text file line by line, with errors that name the line. Private to the mesh readers.
#pragma once
#include <charconv>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace witherfield::terrain {

using Words = std::vector<std::string_view>;

/// The words of a line; they point into it.
Words split(std::string_view line);

/// The whole word as a number, or nothing. Never depends on the locale.
template <class Number>
std::optional<Number> parse(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

class TextLines {
 public:
  /// @throws IoFailure when the file cannot be opened.
  explicit TextLines(const std::string& file);
  bool next();
  const std::string& text() const { return text_; }
  std::int64_t number() const { return number_; }
  std::ifstream& stream() { return in_; }  ///< just after the current line

  [[noreturn]] void malformed(const std::string& what) const;  ///< IoFailure
  [[noreturn]] void invalid(const std::string& what) const;    ///< InvalidInput
  /// @throws IoFailure when the word is no number, InvalidInput when it is not finite.
  double coordinate(std::string_view word) const;
  /// @throws InvalidInput when a vertex number occurs twice.
  void require_distinct(std::vector<std::int64_t> vertices) const;

 private:
  std::string file_, text_;
  std::ifstream in_;
  std::int64_t number_ = 0;
};

}  // namespace witherfield::terrain
