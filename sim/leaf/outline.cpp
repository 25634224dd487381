#include "sim/leaf/outline.hpp"

#include <charconv>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <locale>
#include <sstream>

#include "sim/core/errors.hpp"
#include "sim/leaf/splines.hpp"

namespace witherfield::leaf {
namespace {

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r')) s.remove_suffix(1);
  return s;
}

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> out;
  for (;;) {
    const std::size_t comma = line.find_first_of(",;");
    out.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return out;
    line.remove_prefix(comma + 1);
  }
}

void check_group(const std::vector<glm::dvec3>& points, const char* group) {
  const std::string at = std::string("outline points: ") + group;
  if (points.size() < 2)
    throw InvalidInput(at + " has " + std::to_string(points.size()) + " points, at least 2 are needed");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].x + points[i].y + points[i].z))
      throw InvalidInput(at + " point " + std::to_string(i) + " is not finite");
    if (i > 0 && !(glm::distance(points[i], points[i - 1]) > 0))
      throw InvalidInput(at + " points " + std::to_string(i - 1) + " and " + std::to_string(i) + " coincide");
  }
}

}  // namespace

double metres_per_unit(const std::string& unit) {
  if (unit == "m") return 1;
  if (unit == "cm") return 0.01;
  if (unit == "mm") return 0.001;
  throw InvalidInput("outline points: unit '" + unit + "' is unknown; known: m, cm, mm");
}

OutlinePoints parse_outline_csv(std::string_view text, const std::string& name, const std::string& unit) {
  const double scale = metres_per_unit(unit);
  OutlinePoints out;
  int number = 0;
  bool seen = false;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    if (line.empty() || line.front() == '#') continue;
    const std::string at = name + ":" + std::to_string(number) + ": ";
    const auto cell = cells(line);
    std::vector<glm::dvec3>* group = cell[0] == "left"     ? &out.left_m
                                     : cell[0] == "right"  ? &out.right_m
                                     : cell[0] == "midrib" ? &out.midrib_m
                                                           : nullptr;
    if (!group && !seen) {  // names of the columns
      seen = true;
      continue;
    }
    seen = true;
    if (!group) throw InvalidInput(at + "group '" + std::string(cell[0]) + "' is none of left, right, midrib");
    if (cell.size() < 3 || cell.size() > 4)
      throw InvalidInput(at + std::to_string(cell.size()) + " columns; group,x,y or group,x,y,z are wanted");
    glm::dvec3 p(0.0);
    for (std::size_t c = 1; c < cell.size(); ++c) {
      const auto [stop, error] = std::from_chars(cell[c].data(), cell[c].data() + cell[c].size(), p[int(c) - 1]);
      if (error != std::errc() || stop != cell[c].data() + cell[c].size() || !std::isfinite(p[int(c) - 1]))
        throw InvalidInput(at + "'" + std::string(cell[c]) + "' is not a number");
    }
    group->push_back(scale * p);
  }
  try {
    validate(out);
  } catch (const InvalidInput& e) {
    throw InvalidInput(name + ": " + e.what());
  }
  return out;
}

std::string outline_csv(const OutlinePoints& points) {
  std::ostringstream s;
  s.imbue(std::locale::classic());
  s.precision(9);
  s << "group,x,y,z\n";
  const auto write = [&](const char* group, const std::vector<glm::dvec3>& list) {
    for (const glm::dvec3& p : list) s << group << ',' << p.x << ',' << p.y << ',' << p.z << '\n';
  };
  write("left", points.left_m);
  write("right", points.right_m);
  write("midrib", points.midrib_m);
  return s.str();
}

void validate(const OutlinePoints& points) {
  check_group(points.left_m, "left");
  check_group(points.right_m, "right");
  check_group(points.midrib_m, "midrib");
  // Which side is which, and whether there is an area at all: the vector area of the polygon base-right-tip-left.
  std::vector<glm::dvec3> ring{points.midrib_m.front()};
  ring.insert(ring.end(), points.right_m.begin(), points.right_m.end());
  ring.push_back(points.midrib_m.back());
  ring.insert(ring.end(), points.left_m.rbegin(), points.left_m.rend());
  glm::dvec3 area(0.0);
  double longest = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    area += 0.5 * glm::cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
    longest = std::max(longest, glm::distance(ring[0], ring[i]));
  }
  if (!(glm::length(area) > 1e-6 * longest * longest))
    throw InvalidInput("outline points: left, right and midrib lie on one line; they enclose no area");
}

OutlinePoints sample_outline(const std::vector<glm::dvec2>& outline, int base, int tip, int count, int midrib_count) {
  const int n = int(outline.size());
  const auto walk = [&](int step) {
    std::vector<glm::dvec2> line;
    for (int i = base;; i = (i + step + n) % n) {
      line.push_back(outline[std::size_t(i)]);
      if (i == tip) break;
    }
    const auto even = resample(line, count + 1);
    std::vector<glm::dvec3> points;
    for (int i = 1; i <= count; ++i) points.emplace_back(even[std::size_t(i)].x, even[std::size_t(i)].y, 0);
    return points;
  };
  OutlinePoints out;
  out.right_m = walk(1);
  out.left_m = walk(-1);
  for (int i = 0; i < midrib_count; ++i) {
    const double t = double(i) / (midrib_count - 1);
    const glm::dvec2 p = (1 - t) * outline[std::size_t(base)] + t * outline[std::size_t(tip)];
    out.midrib_m.emplace_back(p.x, p.y, 0);
  }
  return out;
}

}  // namespace witherfield::leaf
