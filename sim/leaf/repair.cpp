#include "sim/leaf/repair.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"

namespace witherfield::leaf {
namespace {

void append_middle(Surface& s, int a, int b) {
  const std::size_t i = std::size_t(a), j = std::size_t(b);
  s.position_m.push_back(0.5 * (s.position_m[i] + s.position_m[j]));
  if (!s.normal.empty()) s.normal.push_back(s.normal[i]);
  if (!s.uv.empty()) s.uv.push_back(0.5 * (s.uv[i] + s.uv[j]));
  for (SurfaceField& f : s.fields) {
    if (f.on_faces) continue;
    const std::size_t n = std::size_t(field_spec(f.name).components);
    for (std::size_t c = 0; c < n; ++c) f.values.push_back(0.5f * (f.values[i * n + c] + f.values[j * n + c]));
  }
}

/// Adds a face like face `like`.
void append_face(Surface& s, const std::array<int, 3>& t, std::size_t like) {
  s.triangles.push_back(t);
  for (SurfaceField& f : s.fields) {
    if (!f.on_faces) continue;
    const std::size_t n = std::size_t(field_spec(f.name).components);
    for (std::size_t c = 0; c < n; ++c) f.values.push_back(f.values[like * n + c]);
  }
}

}  // namespace

std::vector<int> ear_vertices(const Surface& s) {
  std::vector<int> faces(s.position_m.size(), 0);
  for (const auto& t : s.triangles)
    for (const int v : t) ++faces[std::size_t(v)];
  std::vector<int> ears;
  for (std::size_t v = 0; v < faces.size(); ++v)
    if (faces[v] == 1) ears.push_back(int(v));
  return ears;
}

std::vector<EdgeSplit> split_ears(Surface& s) {
  std::map<std::pair<int, int>, std::size_t> face_of;  // directed edge -> face
  const auto enter = [&](std::size_t f) {
    for (std::size_t k = 0; k < 3; ++k) face_of[{s.triangles[f][k], s.triangles[f][(k + 1) % 3]}] = f;
  };
  for (std::size_t f = 0; f < s.triangles.size(); ++f) enter(f);
  std::vector<EdgeSplit> splits;
  for (const int a : ear_vertices(s)) {
    const auto has_a = [a](const auto& t) { return t[0] == a || t[1] == a || t[2] == a; };
    const auto ear = std::find_if(s.triangles.begin(), s.triangles.end(), has_a);
    if (std::find_if(ear + 1, s.triangles.end(), has_a) != s.triangles.end()) continue;  // two ears leaned on each other
    const std::size_t f = std::size_t(ear - s.triangles.begin());
    std::size_t k = 0;
    while ((*ear)[k] != a) ++k;
    const int b = (*ear)[(k + 1) % 3], c = (*ear)[(k + 2) % 3];
    const auto across = face_of.find({c, b});
    if (across == face_of.end())
      throw InvalidInput("leaf mesh: triangle " + std::to_string(f) + " (vertices " + std::to_string(a) + ", " +
                         std::to_string(b) + ", " + std::to_string(c) + ") shares no edge with another one");
    const std::size_t g = across->second;
    int d = -1;
    for (const int v : s.triangles[g])
      if (v != b && v != c) d = v;
    const int e = int(s.position_m.size());
    append_middle(s, b, c);
    s.triangles[f] = {a, b, e};
    append_face(s, {a, e, c}, f);
    s.triangles[g] = {b, d, e};
    append_face(s, {e, d, c}, g);
    face_of.erase({b, c});
    face_of.erase({c, b});
    for (const std::size_t face : {f, g, s.triangles.size() - 2, s.triangles.size() - 1}) enter(face);
    splits.push_back({b, c, e});
  }
  return splits;
}

std::vector<std::vector<int>> border_loops(const std::vector<std::array<int, 3>>& triangles) {
  std::map<std::pair<int, int>, bool> directed;
  for (const auto& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) directed[{t[k], t[(k + 1) % 3]}] = true;
  std::map<int, std::vector<int>> next;
  for (const auto& [edge, unused] : directed)
    if (!directed.count({edge.second, edge.first})) next[edge.first].push_back(edge.second);
  std::vector<std::vector<int>> loops;
  while (!next.empty()) {
    std::vector<int> loop;
    int at = next.begin()->first;
    for (;;) {
      const auto found = next.find(at);
      if (found == next.end()) break;
      loop.push_back(at);
      const int to = found->second.back();
      found->second.pop_back();
      if (found->second.empty()) next.erase(found);
      at = to;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace witherfield::leaf
