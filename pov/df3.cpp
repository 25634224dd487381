#include "pov/df3.hpp"

#include <algorithm>

#include "sim/core/errors.hpp"

namespace witherfield::pov {

std::string encode_df3(std::span<const float> values, int nx, int ny, int nz, double full) {
  for (int n : {nx, ny, nz})
    if (n < 1 || n > 65535)
      throw InvalidInput("encode_df3: a side must have 1..65535 samples, got " + std::to_string(n));
  const std::size_t count = std::size_t(nx) * ny * nz;
  if (values.size() != count)
    throw InvalidInput("encode_df3: " + std::to_string(values.size()) + " values for " +
                       std::to_string(count) + " samples");
  std::string out;
  out.resize(6 + count);
  char* p = out.data();
  for (int n : {nx, nz, ny}) {
    *p++ = static_cast<char>(n >> 8);
    *p++ = static_cast<char>(n & 255);
  }
  const float scale = full > 0 ? static_cast<float>(255.0 / full) : 0.0f;
  for (int y = 0; y < ny; ++y)
    for (int z = 0; z < nz; ++z) {
      const float* row = values.data() + (std::size_t(z) * ny + y) * nx;
      for (int x = 0; x < nx; ++x)
        *p++ = static_cast<char>(static_cast<unsigned char>(std::clamp(row[x] * scale + 0.5f, 0.0f, 255.0f)));
    }
  return out;
}

}  // namespace witherfield::pov
