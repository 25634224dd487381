#include "sim/scene/edited_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "sim/scene/key_visitor.hpp"

namespace witherfield::scene {
namespace {

/// A piece of a TOML file: a line of white space or comment, a table's header, or a key with its value (which may go
/// over several lines).
struct Statement {
  enum class Kind { blank, header, value };
  Kind kind = Kind::blank;
  std::string_view text;  ///< with its end of line
  std::string name;       ///< first part of the header's or key's name: "edit" of [[edit.handle]]
};

/// Where the statement that starts at `at` ends: after the first end of line outside of strings and brackets.
std::size_t end_of_statement(std::string_view toml, std::size_t at) {
  int depth = 0;
  while (at < toml.size()) {
    const char c = toml[at];
    if (c == '"' || c == '\'') {
      const std::string three(3, c);
      const bool is_long = toml.substr(at, 3) == three;
      at += is_long ? 3 : 1;
      while (at < toml.size() && (is_long ? toml.substr(at, 3) != three : toml[at] != c))
        at += (c == '"' && toml[at] == '\\') ? 2 : 1;
      at += is_long ? 3 : 1;
      while (is_long && at < toml.size() && toml[at] == c) ++at;  // quotes right before the closing ones
      continue;
    }
    if (c == '#') {
      at = std::min(toml.find('\n', at), toml.size());
      continue;
    }
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    ++at;
    if (c == '\n' && depth <= 0) return at;
  }
  return toml.size();
}

std::string first_name(std::string_view text) {
  std::size_t at = text.find_first_not_of(" \t[");
  if (at == std::string_view::npos) return "";
  if (text[at] == '"' || text[at] == '\'') return std::string(text.substr(at + 1, text.find(text[at], at + 1) - at - 1));
  const std::size_t end = text.find_first_of(" \t.=]\r\n", at);
  return std::string(text.substr(at, end - at));
}

std::vector<Statement> statements(std::string_view toml) {
  std::vector<Statement> out;
  for (std::size_t at = 0; at < toml.size();) {
    const std::size_t end = end_of_statement(toml, at), first = toml.find_first_not_of(" \t\r\n", at);
    Statement s;
    s.text = toml.substr(at, end - at);
    const bool blank = first == std::string_view::npos || first >= end || toml[first] == '#';
    if (!blank) {
      s.kind = toml[first] == '[' ? Statement::Kind::header : Statement::Kind::value;
      s.name = first_name(s.text);
    }
    out.push_back(std::move(s));
    at = end;
  }
  return out;
}

std::string toml_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string numbers(const std::vector<double>& values) {
  std::string out;
  for (const double v : values) out += (out.empty() ? "" : ", ") + number_text(v);
  return "[" + out + "]";
}

std::string edit_tables(const leaf::EditOptions& e) {
  std::string out = "\n[edit]\n";
  out += fmt::format("mode = \"{}\"\n", e.mode == leaf::EditMode::linear ? "linear" : "rotation_aware");
  out += fmt::format("smoothness = {}\nmax_iterations = {}\ntolerance = {}\n", number_text(e.smoothness), e.max_iterations,
                     number_text(e.tolerance));
  for (const leaf::HandleOptions& h : e.handles) {
    out += "\n[[edit.handle]]\n";
    if (!h.name.empty()) out += fmt::format("name = {}\n", toml_text(h.name));
    if (h.by_uv)
      out += fmt::format("uv = {}\n", numbers({h.uv.x, h.uv.y}));
    else
      out += fmt::format("by_uv = false\npoint_m = {}\n", numbers({h.point_m.x, h.point_m.y, h.point_m.z}));
    if (h.radius_m > 0) out += fmt::format("radius_m = {}\n", number_text(h.radius_m));
    out += fmt::format("weight = {}\n", number_text(h.weight));
  }
  for (const leaf::EditKey& k : e.keys) {
    out += "\n[[edit.key]]\n";
    if (!k.name.empty()) out += fmt::format("name = {}\n", toml_text(k.name));
    std::string moves;
    for (const glm::dvec3& m : k.move_m)
      moves += fmt::format("  {}, {}, {},\n", number_text(m.x), number_text(m.y), number_text(m.z));
    out += fmt::format("move_m = [\n{}]\n", moves);
  }
  return out;
}

}  // namespace

std::string with_edit(std::string_view toml, const SceneEdit& edit) {
  using Kind = Statement::Kind;
  std::string added;  // keys of the top, which must stand before the first table
  if (edit.name) added += fmt::format("name = {}\n", toml_text(*edit.name));
  if (edit.points_file)
    added += fmt::format("points = {}\npoints_unit = {}\n", toml_text(*edit.points_file), toml_text(edit.points_unit));
  if (edit.mesh_file) added += fmt::format("mesh_file = {}\n", toml_text(*edit.mesh_file));
  const auto replaced = [&](const std::string& key) {
    return key == "edit" || (edit.points_file && (key == "points" || key == "points_unit")) ||
           (edit.mesh_file && key == "mesh_file") || (edit.name && key == "name");
  };

  std::string out, gap;  // gap: comments inside the edit's tables, which may belong to the table that follows
  bool at_top = true, in_edit = false;
  std::string last_of_top;
  for (const Statement& s : statements(toml)) {
    if (s.kind == Kind::header) {
      if (at_top) {
        // New keys go right below the last one of the top, above the comments of the first table.
        out += added + last_of_top;
        last_of_top.clear();
        at_top = false;
      }
      const bool was_in_edit = in_edit;
      in_edit = s.name == "edit";
      if (was_in_edit && !in_edit) out += gap;
      gap.clear();
    }
    if (in_edit) {
      s.kind == Kind::blank ? void(gap += s.text) : gap.clear();
    } else if (at_top && s.kind == Kind::blank) {
      last_of_top += s.text;
    } else if (at_top) {
      out += last_of_top;
      last_of_top.clear();
      if (!replaced(s.name)) out += s.text;
    } else {
      out += s.text;
    }
  }
  if (at_top) {
    if (!out.empty() && out.back() != '\n') out += '\n';
    out += added + last_of_top;
  }
  while (out.size() > 1 && out.ends_with("\n\n")) out.pop_back();
  if (!out.empty() && out.back() != '\n') out += '\n';
  return out + edit_tables(edit.edit);
}

}  // namespace witherfield::scene
