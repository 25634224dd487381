#include "pov/png.hpp"

#include <png.h>

#include <algorithm>
#include <csetjmp>

#include "pov/text.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

void append(png_structp png, png_bytep data, png_size_t n) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), n);
}
void flush(png_structp) {}

struct Raw {
  int width, height, depth, colour_type;
  const png_byte* bytes;
  std::size_t row_bytes;
};

// No object with a destructor lives in here: libpng leaves by longjmp.
bool encode(const Raw& raw, png_textp text, int texts, std::string* out) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  if (!png) return false;
  png_infop info = png_create_info_struct(png);
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, out, append, flush);
  png_set_IHDR(png, info, png_uint_32(raw.width), png_uint_32(raw.height), raw.depth, raw.colour_type,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (raw.depth == 8) png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (texts > 0) png_set_text(png, info, text, texts);
  png_write_info(png, info);
  for (int y = 0; y < raw.height; ++y) png_write_row(png, raw.bytes + std::size_t(y) * raw.row_bytes);
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return true;
}

void write(const std::filesystem::path& path, const Raw& raw, const PngText& text = {}) {
  std::vector<png_text> entries(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    entries[i].compression = PNG_TEXT_COMPRESSION_NONE;
    entries[i].key = const_cast<png_charp>(text[i].first.c_str());
    entries[i].text = const_cast<png_charp>(text[i].second.c_str());
    entries[i].text_length = text[i].second.size();
  }
  std::string bytes;
  if (!encode(raw, entries.data(), int(entries.size()), &bytes))
    throw IoFailure("cannot encode " + path.string() + " as PNG");
  write_file(path, bytes);
}

void append16(std::vector<png_byte>& out, float v) {
  const int level = int(std::clamp(v, 0.0f, 1.0f) * 65535.0f + 0.5f);
  out.push_back(png_byte(level >> 8));
  out.push_back(png_byte(level & 255));
}

void check_size(const std::filesystem::path& path, int width, int height, std::size_t got,
                std::size_t per_pixel) {
  if (width < 1 || height < 1 || got != std::size_t(width) * height * per_pixel)
    throw InvalidInput("write_png: " + path.string() + ": " + std::to_string(got) + " values for " +
                       std::to_string(width) + " x " + std::to_string(height) + " pixels");
}

}  // namespace

void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb,
               const PngText& text) {
  check_size(path, width, height, rgb.size(), 3);
  write(path, {width, height, 8, PNG_COLOR_TYPE_RGB, rgb.data(), std::size_t(width) * 3}, text);
}

void write_png_linear(const std::filesystem::path& path, int width, int height,
                      std::span<const glm::vec3> rgb) {
  check_size(path, width, height, rgb.size(), 1);
  std::vector<png_byte> bytes;
  bytes.reserve(rgb.size() * 6);
  for (const glm::vec3& c : rgb)
    for (int k = 0; k < 3; ++k) append16(bytes, c[k]);
  write(path, {width, height, 16, PNG_COLOR_TYPE_RGB, bytes.data(), std::size_t(width) * 6});
}

void write_png_grey(const std::filesystem::path& path, int width, int height, std::span<const float> grey) {
  check_size(path, width, height, grey.size(), 1);
  std::vector<png_byte> bytes;
  bytes.reserve(grey.size() * 2);
  for (float v : grey) append16(bytes, v);
  write(path, {width, height, 16, PNG_COLOR_TYPE_GRAY, bytes.data(), std::size_t(width) * 2});
}

GreyPicture read_png_grey(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw IoFailure("'" + path.string() + "': no such file");
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const auto fail = [&]() {
    const std::string why = image.message;
    png_image_free(&image);
    throw InvalidInput("'" + path.string() + "' cannot be read as a PNG picture: " + why);
  };
  if (!png_image_begin_read_from_file(&image, path.c_str())) fail();
  image.format = PNG_FORMAT_GA;
  std::vector<png_byte> bytes(PNG_IMAGE_SIZE(image));
  if (!png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr)) fail();
  GreyPicture out{int(image.width), int(image.height), {}};
  out.grey.resize(std::size_t(out.width) * std::size_t(out.height));
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const std::size_t from =
          2 * (std::size_t(out.height - 1 - y) * std::size_t(out.width) + std::size_t(x));
      out.grey[std::size_t(y) * std::size_t(out.width) + std::size_t(x)] =
          float(bytes[from]) / 255 * float(bytes[from + 1]) / 255;
    }
  return out;
}

}  // namespace witherfield::pov
