#include <nlohmann/json.hpp>

#include "sim/scene/key_writers.hpp"

namespace witherfield::scene {
namespace {

using Json = nlohmann::ordered_json;

class JsonWriter : public KeyVisitor {
 public:
  explicit JsonWriter(Json& out) : out_(out) { out_ = Json::object(); }

  void number(const Key& key, double& value, const Limits&) override { put(key, value); }
  void optional_number(const Key& key, std::optional<double>& value, const Limits&, double) override {
    if (value) put(key, *value);
  }
  void whole(const Key& key, int& value, const Limits&) override { put(key, value); }
  void seed(const Key& key, std::uint64_t& value) override { put(key, value); }
  void flag(const Key& key, bool& value) override { put(key, value); }
  void text(const Key& key, std::string& value, const Choices&) override { put(key, value); }
  void texts(const Key& key, std::vector<std::string>& value, const Choices&) override { put(key, value); }
  void numbers(const Key& key, std::span<double> values, const Limits&, Order) override {
    put(key, std::vector<double>(values.begin(), values.end()));
  }
  void wholes(const Key& key, std::span<int> values, const Limits&) override {
    put(key, std::vector<int>(values.begin(), values.end()));
  }
  void list(const Key& key, std::vector<double>& values, const Limits&, Order) override { put(key, values); }
  void curve(const Key& key, CurveKeys& keys, const Limits&, Shape) override {
    Json array = Json::array();
    for (const auto& [x, y] : keys) array.push_back(std::vector<double>{x, y});
    put(key, array);
  }
  void pairs(const Key& key, CurveKeys& values, const Limits&, const Limits&) override {
    curve(key, values, {}, Shape::rising);
  }
  void preset(const Key&, const Choices&, std::string_view,
              const std::function<void(const std::string&)>&) override {}
  void table(const Key& key, const Body& body) override {
    JsonWriter inner(out_[std::string(key.name)]);
    body(inner);
  }
  void optional_table(const Key& key, bool present, const std::function<void()>&, const Body& body) override {
    if (present) table(key, body);
  }
  void tables(const Key& key, std::size_t present, const std::function<void(std::size_t)>&,
              const std::function<void(KeyVisitor&, std::size_t)>& body) override {
    Json& array = out_[std::string(key.name)] = Json::array();
    for (std::size_t i = 0; i < present; ++i) {
      array.emplace_back();
      JsonWriter inner(array.back());
      body(inner, i);
    }
  }
  void check(std::string_view, bool, const std::function<std::string()>&) override {}

 private:
  template <class T>
  void put(const Key& key, const T& value) {
    out_[std::string(key.name)] = value;
  }
  Json& out_;
};

/// Collects names; creates every optional and repeated table once to see its keys.
class NameCollector : public KeyVisitor {
 public:
  NameCollector(std::vector<std::string>& paths, std::string prefix)
      : paths_(paths), prefix_(std::move(prefix)) {}

  void number(const Key& key, double&, const Limits&) override { add(key); }
  void optional_number(const Key& key, std::optional<double>&, const Limits&, double) override { add(key); }
  void whole(const Key& key, int&, const Limits&) override { add(key); }
  void seed(const Key& key, std::uint64_t&) override { add(key); }
  void flag(const Key& key, bool&) override { add(key); }
  void text(const Key& key, std::string&, const Choices&) override { add(key); }
  void texts(const Key& key, std::vector<std::string>&, const Choices&) override { add(key); }
  void numbers(const Key& key, std::span<double>, const Limits&, Order) override { add(key); }
  void wholes(const Key& key, std::span<int>, const Limits&) override { add(key); }
  void list(const Key& key, std::vector<double>&, const Limits&, Order) override { add(key); }
  void curve(const Key& key, CurveKeys&, const Limits&, Shape) override { add(key); }
  void pairs(const Key& key, CurveKeys&, const Limits&, const Limits&) override { add(key); }
  void preset(const Key& key, const Choices&, std::string_view,
              const std::function<void(const std::string&)>&) override {
    add(key);
  }
  void table(const Key& key, const Body& body) override {
    NameCollector inner(paths_, prefix_ + std::string(key.name) + ".");
    body(inner);
  }
  void optional_table(const Key& key, bool present, const std::function<void()>& make,
                      const Body& body) override {
    if (!present) make();
    table(key, body);
  }
  void tables(const Key& key, std::size_t, const std::function<void(std::size_t)>& resize,
              const std::function<void(KeyVisitor&, std::size_t)>& body) override {
    resize(1);
    table(key, [&](KeyVisitor& v) { body(v, 0); });
  }
  void check(std::string_view, bool, const std::function<std::string()>&) override {}

 private:
  void add(const Key& key) { paths_.push_back(prefix_ + std::string(key.name)); }
  std::vector<std::string>& paths_;
  std::string prefix_;
};

}  // namespace

std::string values_json(const KeyVisitor::Body& describe, const std::vector<std::string>& leave_out) {
  Json json;
  JsonWriter writer(json);
  describe(writer);
  for (const std::string& name : leave_out) json.erase(name);
  return json.dump(2);
}

std::vector<std::string> key_paths(const KeyVisitor::Body& describe) {
  std::vector<std::string> paths;
  NameCollector collector(paths, "");
  describe(collector);
  return paths;
}

}  // namespace witherfield::scene
