#include "sim/scene/toml_reader.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/core/errors.hpp"

namespace witherfield::scene {

struct TomlFile::Impl {
  std::string path;
  toml::table root;
};

namespace {

/// The value as the user wrote it, nearly.
std::string text_of(const toml::node& node) {
  std::string text;
  if (const auto* number = node.as_floating_point()) {
    text = number_text(number->get());
  } else if (const auto* word = node.as_string()) {
    text = '"' + word->get() + '"';
  } else if (const auto* array = node.as_array()) {
    for (const toml::node& item : *array) text += (text.empty() ? "" : ", ") + text_of(item);
    text = fmt::format("[{}]", text);
  } else {
    std::ostringstream out;
    node.visit([&](const auto& n) { out << n; });
    text = out.str();
  }
  return text.size() > 80 ? text.substr(0, 77) + "..." : text;
}

bool within(double value, const Limits& l) {  // false for NaN
  return (l.above_lo ? value > l.lo : value >= l.lo) && value <= l.hi;
}

/// Reads one table. Remembers which keys were asked for.
class Reader : public KeyVisitor {
 public:
  Reader(const toml::table& table, const std::string& file, std::string prefix, std::uint32_t line,
         const std::vector<std::string>& all_keys)
      : table_(table), file_(file), prefix_(std::move(prefix)), line_(line), all_keys_(all_keys) {}

  void number(const Key& key, double& value, const Limits& limits) override {
    if (const toml::node* node = find(key)) value = number_at(*node, full(key.name), limits);
  }
  void optional_number(const Key& key, std::optional<double>& value, const Limits& limits, double) override {
    if (const toml::node* node = find(key)) value = number_at(*node, full(key.name), limits);
  }
  void whole(const Key& key, int& value, const Limits& limits) override {
    if (const toml::node* node = find(key)) value = whole_at(*node, full(key.name), limits);
  }
  void seed(const Key& key, std::uint64_t& value) override {
    const toml::node* node = find(key);
    if (!node) return;
    const auto* number = node->as_integer();
    if (!number || number->get() < 0)
      fail(*node, full(key.name),
           fmt::format("must be a whole number, 0..{}", std::numeric_limits<std::int64_t>::max()));
    value = std::uint64_t(number->get());
  }
  void flag(const Key& key, bool& value) override {
    const toml::node* node = find(key);
    if (!node) return;
    if (!node->is_boolean()) fail(*node, full(key.name), "must be true or false");
    value = node->as_boolean()->get();
  }
  void text(const Key& key, std::string& value, const Choices& allowed) override {
    if (const toml::node* node = find(key)) value = text_at(*node, full(key.name), allowed);
  }
  void texts(const Key& key, std::vector<std::string>& value, const Choices& allowed) override {
    const toml::node* node = find(key);
    if (!node) return;
    const toml::array& array = array_at(*node, full(key.name), "a list of texts");
    value.clear();
    for (std::size_t i = 0; i < array.size(); ++i) {
      value.push_back(text_at(array[i], element(key, i), allowed));
      if (std::count(value.begin(), value.end(), value.back()) > 1)
        fail(array[i], element(key, i), "is listed twice");
    }
  }
  void numbers(const Key& key, std::span<double> values, const Limits& limits, Order order) override {
    const toml::node* node = find(key);
    if (!node) return;
    const toml::array& array = sized_array(*node, key, values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = number_at(array[i], element(key, i), limits);
      if (i > 0) check_order(array[i], element(key, i), values[i - 1], values[i], order);
    }
  }
  void wholes(const Key& key, std::span<int> values, const Limits& limits) override {
    const toml::node* node = find(key);
    if (!node) return;
    const toml::array& array = sized_array(*node, key, values.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = whole_at(array[i], element(key, i), limits);
  }
  void list(const Key& key, std::vector<double>& values, const Limits& limits, Order order) override {
    const toml::node* node = find(key);
    if (!node) return;
    const toml::array& array = array_at(*node, full(key.name), "a list of numbers");
    values.clear();
    for (std::size_t i = 0; i < array.size(); ++i) {
      values.push_back(number_at(array[i], element(key, i), limits));
      if (i > 0) check_order(array[i], element(key, i), values[i - 1], values[i], order);
    }
  }
  void curve(const Key& key, CurveKeys& keys, const Limits& limits, Shape shape) override;
  void pairs(const Key& key, CurveKeys& values, const Limits& first, const Limits& second) override;
  void preset(const Key& key, const Choices& names, std::string_view preset,
              const std::function<void(const std::string&)>& apply) override {
    const toml::node* node = find(key);
    if (node)
      apply(text_at(*node, full(key.name), names));
    else if (!preset.empty())
      apply(std::string(preset));
  }

  void table(const Key& key, const Body& body) override {
    const toml::node* node = find(key);
    static const toml::table empty;
    if (node && !node->is_table())
      fail(*node, full(key.name), fmt::format("must be a table, [{}]", key.name));
    read_table(node ? *node->as_table() : empty, full(key.name), node ? line_of(*node) : line_, body);
  }
  void optional_table(const Key& key, bool, const std::function<void()>& make, const Body& body) override {
    const toml::node* node = find(key);
    if (!node) return;
    make();
    table(key, body);
  }
  void tables(const Key& key, std::size_t, const std::function<void(std::size_t)>& resize,
              const std::function<void(KeyVisitor&, std::size_t)>& body) override {
    const toml::node* node = find(key);
    if (!node) return;
    if (!node->is_array_of_tables())
      fail(*node, full(key.name),
           fmt::format("must be a list of tables, each starting with [[{}]]", key.name));
    const toml::array& array = *node->as_array();
    resize(array.size());
    for (std::size_t i = 0; i < array.size(); ++i)
      read_table(*array[i].as_table(), element(key, i), line_of(array[i]),
                 [&](KeyVisitor& v) { body(v, i); });
  }

  void check(std::string_view key, bool holds, const std::function<std::string()>& message) override {
    if (holds) return;
    if (const toml::node* node = table_.get(key)) fail(*node, full(key), message());
    throw InvalidInput(fmt::format("{}:{}: {}: {}", file_, line_, full(key), message()));
  }
  bool reading() const override { return true; }
  bool given(std::string_view key) const override { return table_.contains(key); }

  /// @throws InvalidInput for the first key of the table that nobody asked for.
  void finish() const;

 private:
  const toml::node* find(const Key& key) {
    known_.emplace_back(key.name);
    return table_.get(key.name);
  }
  std::string full(std::string_view name) const { return prefix_ + std::string(name); }
  std::string element(const Key& key, std::size_t i) const {
    return fmt::format("{}[{}]", full(key.name), i);
  }
  static std::uint32_t line_of(const toml::node& node) { return node.source().begin.line; }

  [[noreturn]] void fail(const toml::node& node, const std::string& key, const std::string& message) const {
    const bool simple = !node.is_table() && !node.is_array_of_tables();
    throw InvalidInput(fmt::format("{}:{}: {}{}: {}", file_, line_of(node), key,
                                   simple ? " = " + text_of(node) : "", message));
  }

  double number_at(const toml::node& node, const std::string& key, const Limits& limits) const {
    const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value) fail(node, key, "must be a number, " + limits_text(limits));
    if (!within(*value, limits)) fail(node, key, "must be " + limits_text(limits));
    return *value;
  }
  int whole_at(const toml::node& node, const std::string& key, const Limits& limits) const {
    if (!node.is_integer()) fail(node, key, "must be a whole number, " + limits_text(limits));
    const std::int64_t value = node.as_integer()->get();
    if (!within(double(value), limits)) fail(node, key, "must be " + limits_text(limits));
    return int(value);
  }
  std::string text_at(const toml::node& node, const std::string& key, const Choices& allowed) const {
    if (!node.is_string())
      fail(node, key, allowed.empty() ? "must be a text in quotes" : "must be " + quoted_list(allowed, "or"));
    const std::string value = node.as_string()->get();
    if (!allowed.empty() && std::find(allowed.begin(), allowed.end(), value) == allowed.end())
      fail(node, key,
           "must be " + quoted_list(allowed, "or") + "; did you mean \"" + nearest_name(value, allowed) +
               "\"?");
    return value;
  }
  const toml::array& array_at(const toml::node& node, const std::string& key, const std::string& what) const {
    if (!node.is_array()) fail(node, key, "must be " + what);
    return *node.as_array();
  }
  const toml::array& sized_array(const toml::node& node, const Key& key, std::size_t size) const {
    const std::string what = fmt::format("a list of {} numbers", size);
    const toml::array& array = array_at(node, full(key.name), what);
    if (array.size() != size) fail(node, full(key.name), "must be " + what);
    return array;
  }
  void check_order(const toml::node& node, const std::string& key, double before, double value,
                   Order order) const {
    if (order == Order::ascending && value <= before)
      fail(node, key, "must be greater than the one before it, " + number_text(before));
    if (order == Order::not_falling && value < before)
      fail(node, key, "must not be less than the one before it, " + number_text(before));
  }
  void read_table(const toml::table& table, const std::string& name, std::uint32_t line,
                  const Body& body) const {
    Reader reader(table, file_, name + ".", line, all_keys_);
    body(reader);
    reader.finish();
  }

  const toml::table& table_;
  const std::string& file_;
  std::string prefix_;
  std::uint32_t line_;
  const std::vector<std::string>& all_keys_;
  std::vector<std::string> known_;
};

void Reader::curve(const Key& key, CurveKeys& keys, const Limits& limits, Shape shape) {
  const toml::node* node = find(key);
  if (!node) return;
  const char* form = "[[wd, value], [wd, value], ...]";
  const toml::array& array = array_at(*node, full(key.name), std::string("a curve, ") + form);
  if (array.size() == 1) fail(*node, full(key.name), "a curve needs at least 2 keys");
  keys.clear();
  for (std::size_t i = 0; i < array.size(); ++i) {
    const std::string name = element(key, i);
    const toml::array* pair = array[i].as_array();
    if (!pair || pair->size() != 2)
      fail(array[i], name, std::string("must be a pair [wd, value]; a curve is ") + form);
    const double wd = number_at((*pair)[0], name + "[0]", {0, 1, "(wd)"});
    const double value = number_at((*pair)[1], name + "[1]", limits);
    if (i > 0) {
      const auto [wd_before, value_before] = keys.back();
      if (wd <= wd_before)
        fail(array[i], name,
             fmt::format("a curve's time must increase from key to key, but wd {} comes after {}", wd,
                         wd_before));
      if (shape == Shape::falling ? value > value_before : value < value_before)
        fail(array[i], name,
             fmt::format("the curve must not {}, but {} comes after {}",
                         shape == Shape::falling ? "rise" : "fall", value, value_before));
    }
    keys.emplace_back(wd, value);
  }
}

void Reader::pairs(const Key& key, CurveKeys& values, const Limits& first, const Limits& second) {
  const toml::node* node = find(key);
  if (!node) return;
  const char* form = "[[a, b], [a, b], ...]";
  const toml::array& array = array_at(*node, full(key.name), std::string("a list of pairs, ") + form);
  values.clear();
  for (std::size_t i = 0; i < array.size(); ++i) {
    const std::string name = element(key, i);
    const toml::array* pair = array[i].as_array();
    if (!pair || pair->size() != 2)
      fail(array[i], name, std::string("must be a pair of numbers; the key takes ") + form);
    const double a = number_at((*pair)[0], name + "[0]", first);
    values.emplace_back(a, number_at((*pair)[1], name + "[1]", second));
  }
}

void Reader::finish() const {
  // The first in the file's order, not in the table's alphabetical one.
  const toml::key* first = nullptr;
  for (const auto& [key, node] : table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    if (!first || key.source().begin.line < first->source().begin.line) first = &key;
  }
  if (!first) return;
  const std::string name(first->str());
  std::string elsewhere;  // the same key of another table: misplaced rather than misspelt
  for (const std::string& path : all_keys_) {
    const std::size_t dot = path.rfind('.');
    const std::string last = dot == std::string::npos ? path : path.substr(dot + 1);
    if (last != name) continue;
    const std::string home =
        dot == std::string::npos ? "the top of the file" : fmt::format("[{}]", path.substr(0, dot));
    elsewhere += (elsewhere.empty() ? "it belongs in " : " or ") + home;
  }
  const std::string hint =
      elsewhere.empty() ? fmt::format("did you mean '{}'?", nearest_name(name, known_)) : elsewhere;
  throw InvalidInput(
      fmt::format("{}:{}: {}: unknown key; {}", file_, first->source().begin.line, full(name), hint));
}

toml::table parse_text(const std::string& text, const std::string& path) {
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error& e) {
    throw InvalidInput(
        fmt::format("{}:{}: not valid TOML: {}", path, e.source().begin.line, e.description()));
  }
}

toml::table parse(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw IoFailure(path + ": cannot open the scene file (does it exist, and may it be read?)");
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad()) throw IoFailure(path + ": cannot read the scene file");
  return parse_text(text.str(), path);
}

using Json = nlohmann::ordered_json;

toml::table table_of(const Json& object);
toml::array array_of(const Json& items);

/// Calls take(value) with the TOML value of a JSON one.
template <class Take>
void take_value(const Json& json, const Take& take) {
  if (json.is_object()) return take(table_of(json));
  if (json.is_boolean()) return take(json.get<bool>());
  if (json.is_number_integer()) return take(json.get<std::int64_t>());
  if (json.is_number()) return take(json.get<double>());
  if (json.is_string()) return take(json.get<std::string>());
  take(array_of(json));
}

toml::array array_of(const Json& items) {
  toml::array array;
  for (const Json& item : items) take_value(item, [&](auto&& value) { array.push_back(std::move(value)); });
  return array;
}

toml::table table_of(const Json& object) {
  toml::table table;
  for (const auto& [key, json] : object.items()) {
    if (json.is_null() || (json.is_array() && json.empty())) continue;
    take_value(json, [&, &name = key](auto&& value) { table.insert_or_assign(name, std::move(value)); });
  }
  return table;
}

}  // namespace

TomlFile TomlFile::from_json(const std::string& text, const std::string& what) {
  const Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) throw InvalidInput(what + ": not a resolved scene (no JSON object)");
  return TomlFile(std::make_unique<const Impl>(Impl{what, table_of(json)}));
}

TomlFile::TomlFile(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
TomlFile::TomlFile(TomlFile&&) noexcept = default;
TomlFile::TomlFile(const std::string& path) : impl_(new Impl{path, parse(path)}) {}
TomlFile::TomlFile(const std::string& text, const std::string& source)
    : impl_(new Impl{source, parse_text(text, source)}) {}
TomlFile::~TomlFile() = default;

void TomlFile::read(const KeyVisitor::Body& describe, const std::vector<std::string>& all_keys) const {
  Reader reader(impl_->root, impl_->path, "", 1, all_keys);
  describe(reader);
  reader.finish();
}

std::string TomlFile::top_text(const char* key) const {
  const toml::node* node = impl_->root.get(key);
  if (!node) return "";
  if (!node->is_string())
    throw InvalidInput(where(key) + " = " + text_of(*node) + ": must be a text in quotes");
  return node->as_string()->get();
}

int TomlFile::line_of(const std::string& key_path) const {
  int line = 0;
  for (std::string path = key_path; !path.empty();) {
    if (const toml::node* node = impl_->root.at_path(path).node()) {
      line = int(node->source().begin.line);
      if (!node->is_array_of_tables()) return line;
    }
    if (line > 0) return line;
    const std::size_t end = path.find_last_of(".[");
    path.resize(end == std::string::npos ? 0 : end);
  }
  return line;
}

std::string TomlFile::where(const char* key) const {
  const toml::node* node = impl_->root.get(key);
  return fmt::format("{}:{}: {}", impl_->path, node ? node->source().begin.line : 1, key);
}

}  // namespace witherfield::scene
