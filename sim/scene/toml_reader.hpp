// Reads the described keys from a TOML file; every message names file, line, key, value, allowed range and
// unit.
#pragma once
#include <memory>
#include <string>

#include "sim/scene/key_visitor.hpp"

namespace witherfield::scene {

/// A parsed TOML file. The parser's types stay in the .cpp.
class TomlFile {
 public:
  /// @throws IoFailure (cannot read), InvalidInput with the line (not TOML).
  explicit TomlFile(const std::string& path);
  /// Of a text; `source` names it in messages.
  TomlFile(const std::string& text, const std::string& source);
  /// The same from JSON text (a resolved scene). Empty lists count as not stated. @param what named in messages.
  /// @throws InvalidInput when it is no JSON object.
  static TomlFile from_json(const std::string& text, const std::string& what);
  TomlFile(TomlFile&&) noexcept;
  ~TomlFile();

  /// Visits all keys with a reader of this file; afterwards any key of the file that was not described is an
  /// error. `all_keys`: paths of every known key ("season.length_days"), to tell in which table a misplaced
  /// key belongs.
  void read(const KeyVisitor::Body& describe, const std::vector<std::string>& all_keys) const;
  /// A text at the top of the file, "" if there is none. @throws InvalidInput when it is not a text.
  std::string top_text(const char* key) const;
  /// Line of the key or table at a path such as "room.door[1].a_m", or of the nearest one around it that the file states;
  /// 0 when it states none.
  int line_of(const std::string& key_path) const;
  /// "file:line: key" of a top key, for messages.
  std::string where(const char* key) const;

 private:
  struct Impl;
  explicit TomlFile(std::unique_ptr<const Impl> impl);
  std::unique_ptr<const Impl> impl_;
};

}  // namespace witherfield::scene
