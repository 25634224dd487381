#include "sim/scene/kinds.hpp"

#include "sim/core/errors.hpp"
#include "sim/scene/key_visitor.hpp"
#include "sim/scene/scene.hpp"
#include "sim/scene/toml_reader.hpp"

namespace witherfield::scene {
namespace {

struct Kind {
  const char* name;
  std::string (*defaults)();
};
constexpr Kind kKinds[] = {
    {"grass", grass_defaults}, {"fruit", fruit_defaults}, {"floor", floor_defaults}, {"leaf", leaf_defaults}};

std::string names(std::string_view last_word) {
  Choices all;
  for (const Kind& kind : kKinds) all.emplace_back(kind.name);
  return quoted_list(all, last_word);
}

}  // namespace

std::string scene_kind(const std::string& path) {
  const TomlFile file(path);
  const std::string kind = file.top_text("kind");
  if (kind.empty())
    throw InvalidInput(file.where("kind") + ": missing; a scene file starts with kind = " + names("or"));
  for (const Kind& known : kKinds)
    if (kind == known.name) return kind;
  throw InvalidInput(file.where("kind") + " = \"" + kind + "\": must be " + names("or"));
}

void expect_kind(const std::string& path, const char* kind) {
  const std::string found = scene_kind(path);
  if (found != kind)
    throw InvalidInput(path + ": kind = \"" + found + "\", but a scene of kind \"" + kind + "\" is wanted");
}

std::string resolved_path(const std::string& path, const std::filesystem::path& folder) {
  if (path.empty() || std::filesystem::path(path).is_absolute()) return path;
  return (folder / path).lexically_normal().string();
}

std::string print_defaults(const std::string& kind) {
  for (const Kind& known : kKinds)
    if (kind == known.name)
      return "# A complete scene for `witherfield run`: every key with its meaning, range, unit and "
             "default.\n"
             "# Keep what you change, delete the rest. wd is the weathering degree: 0 = fresh, 1 = end of "
             "the "
             "season.\n\n" +
             known.defaults();
  throw InvalidInput("unknown kind of scene '" + kind + "'; known: " + names("and"));
}

}  // namespace witherfield::scene
