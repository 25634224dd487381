// PNG files through libpng: 8-bit sRGB pictures with text, 16-bit linear images for POV-Ray.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace witherfield::pov {

using PngText = std::vector<std::pair<std::string, std::string>>;  ///< keyword, text

/// 8-bit sRGB, 3 bytes a pixel from the top. @throws IoFailure; nothing half-written stays.
void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb,
               const PngText& text = {});
/// 16-bit, linear: value 1 is full scale, clamped. For image_map with gamma 1.0.
void write_png_linear(const std::filesystem::path& path, int width, int height,
                      std::span<const glm::vec3> rgb);
/// 16-bit grey, linear, clamped to [0, 1].
void write_png_grey(const std::filesystem::path& path, int width, int height, std::span<const float> grey);

/// A picture as grey values, 0..1 as stored (no gamma is undone; transparent = 0), rows from the bottom up.
struct GreyPicture {
  int width = 0, height = 0;
  std::vector<float> grey;
};
/// @throws IoFailure (cannot read), InvalidInput (no PNG, or damaged), naming the file.
GreyPicture read_png_grey(const std::filesystem::path& path);

}  // namespace witherfield::pov
