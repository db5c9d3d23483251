#include "linewright/map/image.hpp"

#include <gtest/gtest.h>

#include "linewright/base/diagnostic.hpp"
#include "test_image.hpp"

namespace linewright {
namespace {

using Shades = std::vector<std::uint16_t>;

GrayImage read(const std::string& bytes) { return read_image(bytes, "hall.pgm"); }

std::string complaint(const std::string& bytes) {
  try {
    (void)read(bytes);
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "no complaint";
}

void expect_complaint(const std::string& bytes, const std::string& part) {
  const std::string said = complaint(bytes);
  EXPECT_NE(said.find(part), std::string::npos) << said;
  EXPECT_EQ(said.find("hall.pgm: error: "), 0U) << said;
  EXPECT_NE(said.find("\n  hint: "), std::string::npos) << said;
}

/// An 8-bit value at the full scale.
constexpr std::uint16_t full(int value) { return static_cast<std::uint16_t>(value * 257); }

TEST(PgmImage, TextAndBytesGiveTheSamePixels) {
  const GrayImage text = read("P2\n3 2\n255\n0 1 2\n128 254 255\n");
  EXPECT_EQ(text.width, 3);
  EXPECT_EQ(text.height, 2);
  EXPECT_EQ(text.shade, (Shades{full(0), full(1), full(2), full(128), full(254), full(255)}));
  EXPECT_TRUE(text.alpha.empty());
  EXPECT_EQ(read(pgm(3, 2, {0, 1, 2, 128, 254, 255})).shade, text.shade);
}

TEST(PgmImage, CommentsAndAnyWhiteSpaceMayStandInTheHeader) {
  const GrayImage image = read("P5# made by hand\r\n# 7 8 9\n 2\t#width\n1\v\f255\n\x0a\x23");
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.shade, (Shades{full(0x0a), full(0x23)}));  // a line end and a # are pixels here
  EXPECT_EQ(read("P2 2 1 1 # black, white\n0 # first\n1").shade, (Shades{0, 65535}));
}

TEST(PgmImage, OtherScalesAreStretched) {
  EXPECT_EQ(read("P2 3 1 100 0 50 100").shade, (Shades{0, 32768, 65535}));
  EXPECT_EQ(read(std::string("P5 2 1 65535\n\x12\x34\xff\xff", 17)).shade,
            (Shades{0x1234, 0xffff}));
  EXPECT_EQ(read("P2 1 1 65535 4660").shade, (Shades{0x1234}));
}

TEST(PgmImage, WhatFollowsThePixelsIsIgnored) {
  EXPECT_EQ(read("P5 1 1 255\nAP5 1 1 255\nB").shade, (Shades{full('A')}));
  EXPECT_EQ(read("P2 1 1 255 7 8").shade, (Shades{full(7)}));
}

TEST(PgmImage, SaysWhatIsWrong) {
  expect_complaint("P5 3 2 255\n12345", "the image ends before the last of its 3 x 2 pixels");
  expect_complaint("P5 3 2 65535\n12345678901", "ends before the last");
  expect_complaint("P2 3 2 255\n1 2 3 4 5", "ends before the last");
  expect_complaint("P2 3 2 255\n1 2 3 4 5           ", "ends before the last");
  expect_complaint("P5 3 2 255", "ends before the last");
  expect_complaint("P5 3", "the image's header has no height");
  expect_complaint("P5 -3 2 255\n", "the image's header has no width");
  expect_complaint("P5 3 2 x\n", "the image's header has no largest value");
  expect_complaint("P5 0 2 255\n", "the image has 0 x 2 pixels");
  expect_complaint("P5 3 2 0\n123456", "the header's largest value is 0");
  expect_complaint("P5 3 2 65536\n123456", "the header's largest value is 65536");
  expect_complaint("P2 2 2 255\n1 2 3 256", "pixel 2 of row 2 is 256");
  expect_complaint("P2 2 2 255\n1 2 -3 4", "byte 0x2d among the pixels");
}

TEST(PgmImage, TooManyPixelsAreRefusedBeforeTheyAreLookedAt) {
  expect_complaint("P5 20000 20000 255\n",
                   "the image has 20000 x 20000 pixels: 400000000 cells, more than 16000000: the "
                   "grid would take about 400 MB, and routes on it several times as much");
  EXPECT_NE(complaint("P5 20000 20000 255\n").find("make 'resolution' 5 times as large"),
            std::string::npos);
  expect_complaint("P5 99999999999999999999 99999999999999999999 255\n", "1000000000 x 1000000000");
  expect_complaint("P2 4000 4000 255\n0 0", "ends before the last");
}

TEST(PngImage, GrayOfEveryDepthIsStretched) {
  EXPECT_EQ(read(TestPng{.width = 3, .depth = 8, .samples = {0, 100, 255}}.bytes()).shade,
            (Shades{0, full(100), 65535}));
  EXPECT_EQ(read(TestPng{.width = 2, .depth = 16, .samples = {0x1234, 0xfffe}}.bytes()).shade,
            (Shades{0x1234, 0xfffe}));
  EXPECT_EQ(read(TestPng{.width = 2, .depth = 1, .samples = {1, 0}}.bytes()).shade,
            (Shades{65535, 0}));
  EXPECT_EQ(read(TestPng{.width = 4, .depth = 2, .samples = {0, 1, 2, 3}}.bytes()).shade,
            (Shades{0, full(85), full(170), 65535}));
  EXPECT_EQ(read(TestPng{.width = 2, .depth = 4, .samples = {1, 15}}.bytes()).shade,
            (Shades{full(17), 65535}));
}

TEST(PngImage, ColoursGiveTheMeanOfTheirChannels) {
  const GrayImage colour =
      read(TestPng{.width = 2, .colour_type = PNG_COLOR_TYPE_RGB, .samples = {0, 30, 60, 255, 0, 0}}
               .bytes());
  EXPECT_EQ(colour.shade, (Shades{full(30), full(85)}));
  EXPECT_TRUE(colour.alpha.empty());
  const GrayImage deep = read(TestPng{
      .depth = 16, .colour_type = PNG_COLOR_TYPE_RGB_ALPHA, .samples = {100, 200, 600, 1234}}
                                  .bytes());
  EXPECT_EQ(deep.shade, (Shades{300}));
  EXPECT_EQ(deep.alpha, (Shades{1234}));
}

TEST(PngImage, AlphaIsKeptBesideTheShade) {
  const GrayImage image = read(TestPng{
      .width = 2,
      .colour_type = PNG_COLOR_TYPE_GRAY_ALPHA,
      .samples = {10, 0, 20, 255}}.bytes());
  EXPECT_EQ(image.shade, (Shades{full(10), full(20)}));
  EXPECT_EQ(image.alpha, (Shades{0, 65535}));
}

TEST(PngImage, PalettesAreLookedUp) {
  TestPng png{.width = 3,
              .depth = 2,
              .colour_type = PNG_COLOR_TYPE_PALETTE,
              .samples = {2, 1, 0},
              .palette = {{0, 0, 0}, {10, 20, 30}, {255, 255, 255}}};
  EXPECT_EQ(read(png.bytes()).shade, (Shades{65535, full(20), 0}));
  EXPECT_TRUE(read(png.bytes()).alpha.empty());
  png.alphas = {0};
  EXPECT_EQ(read(png.bytes()).alpha, (Shades{65535, 65535, 0}));
}

TEST(PngImage, InterlacedImagesAreTheSame) {
  TestPng png{.width = 11, .height = 9};
  for (int i = 0; i < 99; ++i) png.samples.push_back(static_cast<std::uint16_t>((i * 37) % 256));
  const GrayImage plain = read(png.bytes());
  png.interlaced = true;
  EXPECT_EQ(read(png.bytes()).shade, plain.shade);
  EXPECT_EQ(plain.shade[12], full((12 * 37) % 256));
}

TEST(PngImage, EveryPrefixIsRefused) {
  TestPng png{.width = 5, .height = 4};
  for (int i = 0; i < 20; ++i) png.samples.push_back(static_cast<std::uint16_t>(i * 12));
  const std::string bytes = png.bytes();
  for (std::size_t size = 8; size < bytes.size(); ++size) {
    expect_complaint(bytes.substr(0, size), "the PNG image is broken: ");
  }
}

TEST(PngImage, EveryChangedByteIsRefusedOrReadWithoutHarm) {
  const std::string good = TestPng{.width = 2, .height = 2, .samples = {1, 2, 3, 4}}.bytes();
  for (std::size_t at = 8; at < good.size(); ++at) {
    std::string changed = good;
    changed[at] = static_cast<char>(changed[at] ^ 0x41);
    testing::internal::CaptureStderr();
    const std::string said = complaint(changed);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << at;
    EXPECT_TRUE(said == "no complaint" || said.find("hall.pgm: error: ") == 0) << said;
  }
}

TEST(PngImage, TooManyPixelsAreRefusedBeforeTheyAreLookedAt) {
  // Headers with a right checksum, and nothing behind them.
  const auto header_only = [](std::int32_t width, std::int32_t height) {
    TestPng png{.width = width, .height = height, .depth = 1};
    png.samples.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    return png.bytes();
  };
  const std::string large = header_only(4001, 4000);
  expect_complaint(large, "the image has 4001 x 4000 pixels: 16004000 cells, more than 16000000");
  const std::string claims = header_only(3000, 3000);
  expect_complaint(claims.substr(0, 100), "the image ends before the last of its 3000 x 3000");
}

TEST(Image, OtherFilesAreNamed) {
  expect_complaint("", "the file is empty");
  expect_complaint("\xff\xd8\xff\xe0 JFIF", "the file is a JPEG image");
  expect_complaint("P6 1 1 255\nabc", "the file is a colour image (PPM)");
  expect_complaint("P5", "the file is no image that is known here");
  expect_complaint("image: hall.pgm\n", "the file is no image that is known here");
  EXPECT_NE(complaint("BM").find("maps are read from PGM (P2, P5) and PNG images"),
            std::string::npos);
}

}  // namespace
}  // namespace linewright
