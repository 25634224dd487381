// One description of the scene's keys drives everything that deals with them: reading TOML, printing a
// commented default scene and writing the resolved scene as JSON. The description (grass_keys.cpp,
// view_keys.cpp) calls a KeyVisitor once for every key.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace witherfield::scene {

using CurveKeys = std::vector<std::pair<double, double>>;
using Choices = std::vector<std::string>;

/// A key (or table) and what it means, one sentence.
struct Key {
  std::string_view name, doc;
};

/// Allowed values: lo..hi, or above lo when lo itself is not allowed.
struct Limits {
  double lo = 0, hi = 0;
  std::string_view unit{};  ///< "" = dimensionless
  bool above_lo = false;
};

enum class Order { any, not_falling, ascending };
enum class Shape { falling, rising };  ///< of a curve's values; both allow level stretches

class KeyVisitor {
 public:
  using Body = std::function<void(KeyVisitor&)>;
  virtual ~KeyVisitor() = default;

  /// Each call names a key and the variable that holds its value: the default when called by a reader, which
  /// overwrites it.
  virtual void number(const Key&, double& value, const Limits&) = 0;
  virtual void optional_number(const Key&, std::optional<double>& value, const Limits&, double example) = 0;
  virtual void whole(const Key&, int& value, const Limits&) = 0;
  virtual void seed(const Key&, std::uint64_t& value) = 0;
  virtual void flag(const Key&, bool& value) = 0;
  virtual void text(const Key&, std::string& value, const Choices& allowed) = 0;  ///< no choices: any text
  virtual void texts(const Key&, std::vector<std::string>& value, const Choices& allowed) = 0;
  virtual void numbers(const Key&, std::span<double> values, const Limits&,
                       Order) = 0;  ///< a fixed number of them
  virtual void wholes(const Key&, std::span<int> values, const Limits&) = 0;
  virtual void list(const Key&, std::vector<double>& values, const Limits&, Order) = 0;
  virtual void curve(const Key&, CurveKeys& keys, const Limits& value_limits, Shape) = 0;
  /// Points in a plane, or keys of a curve over something else than wd: any number of pairs.
  virtual void pairs(const Key&, CurveKeys& values, const Limits& first, const Limits& second) = 0;
  /// A named set of values for the keys that follow; `preset` "" = none unless asked for. Not part of the
  /// resolved scene.
  virtual void preset(const Key&, const Choices& names, std::string_view preset,
                      const std::function<void(const std::string&)>& apply) = 0;

  virtual void table(const Key&, const Body& body) = 0;
  /// A table that may be left out. `make` creates the options that the body then describes.
  virtual void optional_table(const Key&, bool present, const std::function<void()>& make,
                              const Body& body) = 0;
  /// [[name]], any number of them.
  virtual void tables(const Key&, std::size_t present, const std::function<void(std::size_t)>& resize,
                      const std::function<void(KeyVisitor&, std::size_t)>& body) = 0;

  /// The same where a scene needs at least one of them (printed defaults show it live).
  virtual void required_tables(const Key& key, std::size_t present, const std::function<void(std::size_t)>& resize,
                               const std::function<void(KeyVisitor&, std::size_t)>& body) {
    tables(key, present, resize, body);
  }

  /// A condition between keys; the reader reports it at `key` when it does not hold.
  virtual void check(std::string_view key, bool holds, const std::function<std::string()>& message) = 0;
  virtual bool reading() const { return false; }
  virtual bool given(std::string_view) const { return false; }  ///< the file states this key (readers only)
};

template <class E>
struct Named {
  const char* name;
  E value;
};

/// A key whose value is one of a few words.
template <class E, std::size_t N>
void choice(KeyVisitor& v, const Key& key, E& value, const Named<E> (&names)[N]) {
  Choices allowed;
  std::string word;
  for (const Named<E>& n : names) {
    allowed.emplace_back(n.name);
    if (n.value == value) word = n.name;
  }
  v.text(key, word, allowed);
  for (const Named<E>& n : names)
    if (word == n.name) value = n.value;
}

/// "1..1000 days", "greater than 0, at most 1000 points".
std::string limits_text(const Limits& limits);
/// Shortest text that reads back to the same double.
std::string number_text(double value);
/// The name in `known` with the smallest edit distance to `name`; "" when known is empty.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);
/// "a", "b" or "c".
std::string quoted_list(const Choices& names, std::string_view last_word);

}  // namespace witherfield::scene
