// Small tools of the writers in this folder: numbers as text (locale-free), files written under a temporary
// name and renamed when whole, and the one place where coordinates are flipped for POV-Ray.
#pragma once
#include <concepts>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

namespace witherfield::pov {

/// Appends text; doubles with 7 significant digits by std::to_chars (never a decimal comma).
class Text {
 public:
  Text& operator<<(std::string_view s) {
    text_ += s;
    return *this;
  }
  Text& operator<<(double value);
  Text& operator<<(std::integral auto value) {
    text_ += std::to_string(value);
    return *this;
  }
  /// "<x,y,z>" as it stands (already in POV-Ray's order).
  Text& operator<<(const glm::dvec3& v);
  const std::string& str() const { return text_; }

 private:
  std::string text_;
};

/// POV-Ray is left-handed with y up: (x, y, z) -> (x, z, y). `unit` is POV-Ray units per metre.
inline glm::dvec3 flip(const glm::dvec3& p, double unit = 1.0) {
  return {p.x * unit, p.z * unit, p.y * unit};
}

/// Writes a file whole or not at all. @throws IoFailure naming the file.
void write_file(const std::filesystem::path& path, std::string_view bytes);
/// @throws IoFailure naming the file.
std::string read_file(const std::filesystem::path& path);

}  // namespace witherfield::pov
