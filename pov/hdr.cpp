#include "pov/hdr.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

using Rgbe = std::array<unsigned char, 4>;

Rgbe to_rgbe(const glm::vec3& c) {
  const float top = std::max({c.x, c.y, c.z});
  if (!(top > 1e-32f)) return {0, 0, 0, 0};
  int exponent = 0;
  std::frexp(top, &exponent);
  const auto level = [&](float v) {
    return static_cast<unsigned char>(std::clamp(std::ldexp(std::max(v, 0.0f), 8 - exponent), 0.0f, 255.0f));
  };
  return {level(c.x), level(c.y), level(c.z), static_cast<unsigned char>(exponent + 128)};
}

glm::vec3 from_rgbe(const Rgbe& p) {
  if (p[3] == 0) return glm::vec3(0.0f);
  const float scale = std::ldexp(1.0f, int(p[3]) - 136);
  return {(p[0] + 0.5f) * scale, (p[1] + 0.5f) * scale, (p[2] + 0.5f) * scale};
}

struct Reader {
  std::string_view bytes;
  const std::string& what;
  std::size_t at = 0;

  [[noreturn]] void fail(const char* why) const {
    throw IoFailure(what + ": not a whole Radiance HDR picture (" + why + ")");
  }
  unsigned char next() {
    if (at >= bytes.size()) fail("it ends early");
    return static_cast<unsigned char>(bytes[at++]);
  }
  std::string_view line() {
    const std::size_t end = bytes.find('\n', at);
    if (end == std::string_view::npos) fail("header without end");
    const std::string_view l = bytes.substr(at, end - at);
    at = end + 1;
    return l;
  }
  void packed_row(std::vector<Rgbe>& row) {
    for (int channel = 0; channel < 4; ++channel)
      for (std::size_t x = 0; x < row.size();) {
        const int n = next();
        const std::size_t run = static_cast<std::size_t>(n > 128 ? n - 128 : n);
        if (run == 0 || x + run > row.size()) fail("bad run length");
        if (n > 128) {
          const unsigned char v = next();
          for (std::size_t i = 0; i < run; ++i) row[x++][channel] = v;
        } else {
          for (std::size_t i = 0; i < run; ++i) row[x++][channel] = next();
        }
      }
  }
  void read_row(std::vector<Rgbe>& row) {
    Rgbe first{next(), next(), next(), next()};
    const bool packed = first[0] == 2 && first[1] == 2 && first[2] < 128;
    if (packed) {
      if (std::size_t(first[2]) * 256 + first[3] != row.size()) fail("row of another width");
      return packed_row(row);
    }
    row[0] = first;
    for (std::size_t x = 1; x < row.size(); ++x) row[x] = {next(), next(), next(), next()};
  }
};

void append_packed(std::string& out, const std::vector<Rgbe>& row, int channel) {
  const std::size_t n = row.size();
  const auto value = [&](std::size_t x) { return row[x][static_cast<std::size_t>(channel)]; };
  const auto run_at = [&](std::size_t x) {
    std::size_t r = 1;
    while (x + r < n && r < 127 && value(x + r) == value(x)) ++r;
    return r;
  };
  for (std::size_t x = 0; x < n;) {
    const std::size_t run = run_at(x);
    if (run >= 4) {
      out += static_cast<char>(128 + run);
      out += static_cast<char>(value(x));
      x += run;
      continue;
    }
    std::size_t end = x + run;
    while (end < n && end - x < 124 && run_at(end) < 4) ++end;
    out += static_cast<char>(end - x);
    for (; x < end; ++x) out += static_cast<char>(value(x));
  }
}

}  // namespace

HdrImage decode_hdr(std::string_view bytes, const std::string& what) {
  Reader in{bytes, what};
  if (!in.line().starts_with("#?")) in.fail("no #? at the start");
  while (!in.line().empty()) {
  }
  HdrImage image;
  const std::string size(in.line());
  if (std::sscanf(size.c_str(), "-Y %d +X %d", &image.height, &image.width) != 2 || image.width < 1 ||
      image.height < 1 || image.width > 65535 || image.height > 65535)
    in.fail("unknown size line");
  image.pixel.reserve(std::size_t(image.width) * image.height);
  std::vector<Rgbe> row(static_cast<std::size_t>(image.width));
  for (int y = 0; y < image.height; ++y) {
    in.read_row(row);
    for (const Rgbe& p : row) image.pixel.push_back(from_rgbe(p));
  }
  return image;
}

std::string encode_hdr(const HdrImage& image) {
  std::string out = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(image.height) + " +X " +
                    std::to_string(image.width) + "\n";
  const bool packed = image.width >= 8 && image.width <= 32767;
  std::vector<Rgbe> row(static_cast<std::size_t>(image.width));
  for (int y = 0; y < image.height; ++y) {
    for (std::size_t x = 0; x < row.size(); ++x)
      row[x] = to_rgbe(image.pixel[std::size_t(y) * row.size() + x]);
    if (!packed) {
      for (const Rgbe& p : row) out.append(reinterpret_cast<const char*>(p.data()), 4);
      continue;
    }
    for (int v : {2, 2, image.width >> 8, image.width & 255}) out += static_cast<char>(v);
    for (int channel = 0; channel < 4; ++channel) append_packed(out, row, channel);
  }
  return out;
}

}  // namespace witherfield::pov
