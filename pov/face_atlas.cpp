#include "pov/face_atlas.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "pov/text.hpp"

namespace witherfield::pov {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

FaceAtlas::FaceAtlas(std::span<const std::array<int, 3>> triangles, std::span<const glm::vec3> colour)
    : triangles_(triangles) {
  const std::size_t faces = triangles.size();
  columns_ = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(faces)))));
  rows_ = std::max(1, static_cast<int>((faces + at(columns_) - 1) / at(columns_)));
  first_.reserve(faces);
  const auto sum = [&](int vertex) {
    const glm::vec3& c = colour[at(vertex)];
    return c.x + c.y + c.z;
  };
  for (const auto& t : triangles) {
    unsigned char darkest = 0;
    for (unsigned char k = 1; k < 3; ++k)
      if (sum(t[k]) < sum(t[darkest])) darkest = k;
    first_.push_back(darkest);
  }
}

std::vector<glm::vec3> FaceAtlas::paint(std::span<const glm::vec3> colour) const {
  std::vector<glm::vec3> texels(at(width()) * at(height()), glm::vec3(0.0f));
  for (std::size_t f = 0; f < first_.size(); ++f) {
    const auto& t = triangles_[f];
    const glm::vec3 a = colour[at(t[first_[f]])], b = colour[at(t[(first_[f] + 1u) % 3])],
                    c = colour[at(t[(first_[f] + 2u) % 3])];
    const std::size_t column = f % at(columns_), row = f / at(columns_);
    glm::vec3* lower = &texels[(at(height()) - 1 - 2 * row) * at(width()) + 2 * column];
    glm::vec3* upper = lower - width();
    lower[0] = a;
    lower[1] = b;
    upper[0] = c;
    upper[1] = glm::max(b + c - a, 0.0f);
  }
  return texels;
}

glm::ivec2 FaceAtlas::corner(std::size_t face, int k) const {
  const int column = static_cast<int>(face % at(columns_)), row = static_cast<int>(face / at(columns_));
  const int place = (k + 3 - first_[face]) % 3;  // 0 origin, 1 to its right, 2 above it
  return {4 * column + 1 + (place == 1 ? 2 : 0), 4 * row + 1 + (place == 2 ? 2 : 0)};
}

std::string FaceAtlas::scale() const {
  return (Text() << "scale <" << 2 * width() << "," << 2 * height() << ",1>").str();
}

}  // namespace witherfield::pov
