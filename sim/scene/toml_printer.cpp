#include <fmt/format.h>

#include <utility>

#include "sim/scene/key_writers.hpp"

namespace witherfield::scene {
namespace {

std::string toml_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

template <class Items, class ToText>
std::string bracketed(const Items& items, const ToText& to_text) {
  std::string text = "[";
  for (const auto& item : items) text += (text.size() > 1 ? ", " : "") + to_text(item);
  return text + "]";
}

class Printer : public KeyVisitor {
 public:
  /// @param plain values alone, nothing commented out.
  Printer(std::string& out, bool commented, bool plain = false, std::string prefix = "")
      : out_(out), margin_(commented ? "# " : ""), plain_(plain), prefix_(std::move(prefix)) {}

  void number(const Key& key, double& value, const Limits& limits) override {
    line(key, limits_text(limits), number_text(value));
  }
  void optional_number(const Key& key, std::optional<double>& value, const Limits& limits,
                       double example) override {
    if (!plain_ || value) line(key, limits_text(limits), number_text(value.value_or(example)), !value);
  }
  void whole(const Key& key, int& value, const Limits& limits) override {
    line(key, limits_text(limits), std::to_string(value));
  }
  void seed(const Key& key, std::uint64_t& value) override { line(key, "", std::to_string(value)); }
  void flag(const Key& key, bool& value) override { line(key, "true or false", value ? "true" : "false"); }
  void text(const Key& key, std::string& value, const Choices& allowed) override {
    line(key, quoted_list(allowed, "or"), toml_text(value));
  }
  void texts(const Key& key, std::vector<std::string>& value, const Choices& allowed) override {
    line(key, allowed.empty() ? "" : "any of " + quoted_list(allowed, "and"), bracketed(value, toml_text));
  }
  void numbers(const Key& key, std::span<double> values, const Limits& limits, Order) override {
    line(key, limits_text(limits), bracketed(values, number_text));
  }
  void wholes(const Key& key, std::span<int> values, const Limits& limits) override {
    line(key, limits_text(limits), bracketed(values, [](int v) { return std::to_string(v); }));
  }
  void list(const Key& key, std::vector<double>& values, const Limits& limits, Order) override {
    line(key, limits_text(limits), bracketed(values, number_text));
  }
  void curve(const Key& key, CurveKeys& keys, const Limits& limits, Shape shape) override {
    line(key, limits_text(limits) + (shape == Shape::falling ? ", not rising" : ", not falling"),
         bracketed(keys, [](const auto& k) { return fmt::format("[{}, {}]", k.first, k.second); }));
  }
  void pairs(const Key& key, CurveKeys& values, const Limits& first, const Limits& second) override {
    line(key, "pairs of " + limits_text(first) + " and " + limits_text(second),
         bracketed(values, [](const auto& k) { return fmt::format("[{}, {}]", k.first, k.second); }));
  }
  void preset(const Key& key, const Choices& names, std::string_view preset,
              const std::function<void(const std::string&)>&) override {
    if (!plain_) line(key, quoted_list(names, "or"), toml_text(preset.empty() ? names.front() : std::string(preset)),
         preset.empty());
  }
  void table(const Key& key, const Body& body) override { print_table(key, "[", "]", false, body); }
  void optional_table(const Key& key, bool present, const std::function<void()>& make, const Body& body) override {
    if (plain_ && !present) return;
    if (!present) make();
    print_table(key, "[", "]", true, body);
  }
  void tables(const Key& key, std::size_t present, const std::function<void(std::size_t)>&,
              const std::function<void(KeyVisitor&, std::size_t)>& body) override {
    for (std::size_t i = 0; i < present; ++i)
      print_table(key, "[[", "]]", true, [&](KeyVisitor& v) { body(v, i); });
  }
  void required_tables(const Key& key, std::size_t present, const std::function<void(std::size_t)>&,
                       const std::function<void(KeyVisitor&, std::size_t)>& body) override {
    for (std::size_t i = 0; i < present; ++i)
      print_table(key, "[[", "]]", false, [&](KeyVisitor& v) { body(v, i); });
  }
  void check(std::string_view, bool, const std::function<std::string()>&) override {}
  /// Tables come after all keys of the table they stand in, whatever the order of the visit: TOML takes a key for one
  /// of the last table above it.
  void finish() { out_ += std::exchange(tables_, {}); }

 private:
  void line(const Key& key, const std::string& range, const std::string& value, bool commented = false) {
    if (!plain_) out_ += fmt::format("{}# {}{}\n", margin_, key.doc, range.empty() ? "" : ". [" + range + "]");
    out_ += fmt::format("{}{}{} = {}\n", margin_, commented ? "# " : "", key.name, value);
  }
  void print_table(const Key& key, const char* open, const char* close, bool commented, const Body& body) {
    const bool quiet = plain_ || !(commented || !margin_.empty());
    const std::string margin = quiet ? "" : "# ", name = prefix_ + std::string(key.name);
    if (!plain_) tables_ += fmt::format("\n{}# {}.\n", margin, key.doc);
    tables_ += fmt::format("{}{}{}{}\n", margin, open, name, close);
    Printer inner(tables_, !quiet, plain_, name + ".");
    body(inner);
    inner.finish();
  }

  std::string& out_;
  std::string tables_;
  std::string margin_;
  bool plain_;
  std::string prefix_;
};

}  // namespace

std::string commented_toml(const KeyVisitor::Body& describe) {
  std::string out;
  Printer printer(out, false);
  describe(printer);
  printer.finish();
  return out;
}

std::string values_toml(const KeyVisitor::Body& describe) {
  std::string out;
  Printer printer(out, false, true);
  describe(printer);
  printer.finish();
  return out;
}

}  // namespace witherfield::scene
