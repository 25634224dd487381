// HDR, tone mapping, PNG.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "pov/hdr.hpp"
#include "pov/png.hpp"
#include "pov/text.hpp"
#include "pov/tonemap.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

namespace fs = std::filesystem;

struct TemporaryFolder {
  fs::path path = fs::temp_directory_path() / ("witherfield_picture_" + std::to_string(getpid()));
  TemporaryFolder() { fs::create_directories(path); }
  ~TemporaryFolder() { fs::remove_all(path); }
};

TEST(Hdr, ReadsARunLengthFileMadeByHand) {
  // 8 x 1: red mantissa 128 eight times (a run), green 1..8 (dump), blue 0, exponent 129 -> scale
  // 2^(129-136).
  std::string file = "#?RADIANCE\nSOFTWARE=hand\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n";
  file += std::string("\x02\x02\x00\x08", 4);
  file += std::string("\x88\x80", 2);
  file += std::string("\x08\x01\x02\x03\x04\x05\x06\x07\x08", 9);
  file += std::string("\x88\x00", 2);
  file += std::string("\x88\x81", 2);
  const HdrImage image = decode_hdr(file, "hand");
  ASSERT_EQ(image.width, 8);
  ASSERT_EQ(image.height, 1);
  EXPECT_NEAR(image.pixel[5].x, 128.5 / 128, 1e-6);
  EXPECT_NEAR(image.pixel[5].y, 6.5 / 128, 1e-6);
  EXPECT_NEAR(image.pixel[0].y, 1.5 / 128, 1e-6);
}

TEST(Hdr, RoundTripsWithinItsPrecision) {
  for (const int width : {5, 40}) {  // flat and packed
    HdrImage image;
    image.width = width;
    image.height = 7;
    for (int i = 0; i < width * 7; ++i)
      image.pixel.push_back(i % 9 < 4
                                ? glm::vec3(0.25f, 0.5f, 1.0f)
                                : glm::vec3(float(std::exp(0.37 * (i % 31) - 5)), 0.1f * float(i % 3), 3.0f));
    const HdrImage back = decode_hdr(encode_hdr(image), "round trip");
    ASSERT_EQ(back.pixel.size(), image.pixel.size());
    for (std::size_t i = 0; i < image.pixel.size(); ++i) {
      const float top = std::max({image.pixel[i].x, image.pixel[i].y, image.pixel[i].z});
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(back.pixel[i][c], image.pixel[i][c], top / 128) << i;
    }
  }
}

TEST(Hdr, RefusesWhatIsCutShort) {
  HdrImage image{16, 4, std::vector<glm::vec3>(64, glm::vec3(0.5f))};
  const std::string whole = encode_hdr(image);
  EXPECT_THROW(decode_hdr(whole.substr(0, whole.size() - 3), "cut"), IoFailure);
  EXPECT_THROW(decode_hdr("P6 1 1 255 ...\n", "no hdr"), IoFailure);
}

TEST(ToneMap, GreysStayGreyAndBrighterIsBrighter) {
  double before = -1;
  for (double v = 0; v < 40; v = v * 1.3 + 0.001) {
    const glm::dvec3 c = tone_map(glm::dvec3(v));
    EXPECT_NEAR(c.x, c.y, 1e-4) << v;
    EXPECT_NEAR(c.y, c.z, 1e-4) << v;
    if (before < 0.9999) {
      EXPECT_GE(c.y, before) << v;
    }
    before = c.y;
  }
  EXPECT_LT(tone_map(glm::dvec3(0.0)).y, 1e-3);
  EXPECT_GT(tone_map(glm::dvec3(30.0)).y, 0.97);
  const glm::dvec3 green = tone_map({0.1, 0.3, 0.05});
  EXPECT_GT(green.y, green.x);
  EXPECT_GT(green.x, green.z);
}

TEST(ToneMap, SharpeningKeepsFlatPicturesFlat) {
  HdrImage flat{12, 9, std::vector<glm::vec3>(108, glm::vec3(0.2f, 0.3f, 0.1f))};
  EXPECT_EQ(develop(flat, 1.0, 0.8), develop(flat, 1.0, 0.0));
}

TEST(ToneMap, MendsLonePixelsAndNothingElse) {
  HdrImage image{20, 10, {}};
  for (int i = 0; i < 200; ++i) image.pixel.push_back(glm::vec3(0.2f + 0.01f * float(i % 20)));  // a ramp
  const HdrImage ramp = image;
  EXPECT_EQ(mend_specks(image), 0);
  image.pixel[5 * 20 + 7] = glm::vec3(3.0f);
  image.pixel[3 * 20 + 14] = glm::vec3(0.0f);
  EXPECT_EQ(mend_specks(image), 2);
  for (std::size_t i = 0; i < ramp.pixel.size(); ++i)
    EXPECT_NEAR(image.pixel[i].x, ramp.pixel[i].x, 0.02f) << i;
  image.pixel[5 * 20 + 7] = image.pixel[5 * 20 + 8] = glm::vec3(3.0f);  // two side by side are a thing
  EXPECT_EQ(mend_specks(image), 0);
}

TEST(Png, WritesTextAndLeavesNothingHalfWritten) {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> pixels(4 * 3 * 3, 200);
  write_png(folder.path / "a.png", 4, 3, pixels, {{"Software", "witherfield"}});
  const std::string bytes = read_file(folder.path / "a.png");
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  EXPECT_NE(bytes.find("witherfield"), std::string::npos);
  EXPECT_THROW(write_png(folder.path / "b.png", 5, 3, pixels), InvalidInput);
  EXPECT_THROW(write_png(folder.path / "none" / "c.png", 4, 3, pixels), IoFailure);
  fs::create_directories(folder.path / "d.png" / "full");  // a folder stands where the picture should go
  EXPECT_THROW(write_png(folder.path / "d.png", 4, 3, pixels), IoFailure);
  std::size_t files = 0;
  for (const auto& e : fs::directory_iterator(folder.path)) files += e.is_regular_file();
  EXPECT_EQ(files, 1u);
}

TEST(Text, NumbersNeverDependOnTheLocale) {
  EXPECT_EQ((Text() << 0.5 << " " << 1e-7 << " " << 123456.0).str(), "0.5 1e-07 123456");
  EXPECT_EQ((Text() << glm::dvec3(1, -2.25, 0)).str(), "<1,-2.25,0>");
}

}  // namespace
}  // namespace witherfield::pov
