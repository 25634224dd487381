#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/core/errors.hpp"
#include "sim/leaf/outline.hpp"

namespace witherfield::leaf {
namespace {

using Json = nlohmann::json;

std::vector<glm::dvec3> group_of(const Json& document, const char* group, double scale, const std::string& name) {
  const std::string at = name + ": " + group;
  const auto found = document.find(group);
  if (found == document.end()) throw InvalidInput(at + " is missing; left, right and midrib are wanted");
  if (!found->is_array()) throw InvalidInput(at + " is not a list of points [x, y] or [x, y, z]");
  std::vector<glm::dvec3> points;
  for (const Json& item : *found) {
    const std::string which = at + "[" + std::to_string(points.size()) + "]";
    if (!item.is_array() || item.size() < 2 || item.size() > 3)
      throw InvalidInput(which + " = " + item.dump() + " is not a point [x, y] or [x, y, z]");
    glm::dvec3 p(0.0);
    for (std::size_t c = 0; c < item.size(); ++c) {
      if (!item[c].is_number()) throw InvalidInput(which + "[" + std::to_string(c) + "] = " + item[c].dump() + " is not a number");
      p[int(c)] = item[c].get<double>();
    }
    points.push_back(scale * p);
  }
  return points;
}

}  // namespace

OutlinePoints parse_outline_json(std::string_view text, const std::string& name, const std::string& unit) {
  Json document;
  try {
    document = Json::parse(text);
  } catch (const Json::parse_error& e) {
    const auto line = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(std::min(e.byte, text.size())), '\n');
    throw InvalidInput(name + ":" + std::to_string(line) + ": not valid JSON (at byte " + std::to_string(e.byte) + ")");
  }
  if (!document.is_object()) throw InvalidInput(name + ": an object with left, right and midrib is wanted");
  for (const auto& [key, value] : document.items())
    if (key != "unit" && key != "left" && key != "right" && key != "midrib")
      throw InvalidInput(name + ": key '" + key + "' is unknown; known: left, right, midrib, unit");
  std::string own = unit;
  if (const auto stated = document.find("unit"); stated != document.end()) {
    if (!stated->is_string()) throw InvalidInput(name + ": unit = " + stated->dump() + " is none of \"m\", \"cm\", \"mm\"");
    own = stated->get<std::string>();
  }
  OutlinePoints out;
  try {
    const double scale = metres_per_unit(own);
    out = {group_of(document, "left", scale, name), group_of(document, "right", scale, name), group_of(document, "midrib", scale, name)};
    validate(out);
  } catch (const InvalidInput& e) {
    const std::string what = e.what();
    throw InvalidInput(what.rfind(name, 0) == 0 ? what : name + ": " + what);
  }
  return out;
}

}  // namespace witherfield::leaf
