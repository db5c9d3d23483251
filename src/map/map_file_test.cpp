#include "linewright/map/map_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/base/random.hpp"
#include "test_image.hpp"

namespace linewright {
namespace {

const std::string kUsual =
    "image: hall.pgm\nresolution: 0.5\norigin: [-1, 2, 0]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

OccupancyGrid read(const std::string& yaml, const std::string& image) {
  return read_map_text(yaml, "maps/hall.yaml",
                       [&](const std::string&, std::string&) { return std::optional(image); })
      .grid;
}

/// One letter per cell, row by row from the bottom: '.' free, '#' occupied, '?' unknown.
std::string cells(const OccupancyGrid& grid) {
  std::string text;
  for (const CellState state : grid.cells()) {
    text += state == CellState::kFree ? '.' : state == CellState::kOccupied ? '#' : '?';
  }
  return text;
}

std::string cells(const std::string& yaml, const std::string& image) {
  return cells(read(yaml, image));
}

std::string complaint(const std::string& yaml, const std::string& image = pgm(1, 1, {0})) {
  try {
    (void)read(yaml, image);
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "no complaint";
}

std::string with(const std::string& key, const std::string& line) {
  std::string text = kUsual;
  const std::size_t start = text.find(key);
  return text.replace(start, text.find('\n', start) - start, line);
}

TEST(MapFile, TheFirstRowOfTheImageIsTheTopOne) {
  const OccupancyGrid grid = read(kUsual, pgm(3, 2, {0, 254, 254, 254, 254, 205}));
  EXPECT_EQ(cells(grid), "..?#..");
  EXPECT_EQ(grid.columns(), 3);
  EXPECT_EQ(grid.rows(), 2);
  EXPECT_EQ(grid.cell_m(), 0.5);
  EXPECT_EQ(grid.state(grid.frame().cell_at({-0.9, 2.9})), CellState::kOccupied);
  EXPECT_EQ(grid.state(grid.frame().cell_at({0.4, 2.1})), CellState::kUnknown);
}

TEST(MapFile, TheOriginMayBeTurned) {
  const OccupancyGrid grid =
      read(with("origin", "origin: [10, 20, 1.5707963267948966]"), pgm(3, 1, {254, 254, 0}));
  // Columns run along +y now.
  EXPECT_EQ(grid.frame().cell_at({9.9, 21.2}), (Cell{2, 0}));
  EXPECT_EQ(grid.state({2, 0}), CellState::kOccupied);
}

TEST(MapFile, TrinaryComparesStrictlyWithTheThresholds) {
  const std::string yaml = with("occupied", "occupied_thresh: 0.6") + "mode: trinary\n";
  const std::string at_free = "free_thresh: 0.2\n";
  const std::string changed = yaml.substr(0, yaml.find("free_")) + at_free;
  // Darkness of 204: 51/255 = 0.2, of 102: 153/255 = 0.6.
  EXPECT_EQ(cells(changed, pgm(4, 1, {205, 204, 102, 101})), ".??#");
}

TEST(MapFile, NegateSwapsBlackAndWhite) {
  EXPECT_EQ(cells(with("negate", "negate: 1"), pgm(3, 1, {0, 128, 255})), ".?#");
  EXPECT_EQ(cells(with("negate", "negate: true"), pgm(2, 1, {0, 255})), ".#");
  EXPECT_EQ(cells(with("negate", "negate: false"), pgm(2, 1, {0, 255})), "#.");
}

TEST(MapFile, TrinaryCountsAlphaAsAChannelAndScaleTakesItForUnknown) {
  TestPng png{.width = 3,
              .colour_type = PNG_COLOR_TYPE_RGB_ALPHA,
              .samples = {0, 0, 0, 255, 254, 254, 254, 255, 254, 254, 254, 0}};
  EXPECT_EQ(cells(kUsual, png.bytes()), "#.?");  // the last: 3/4 of 254
  EXPECT_EQ(cells(kUsual + "mode: scale\n", png.bytes()), "#.?");
  png.samples = {0, 0, 0, 0, 254, 254, 254, 254, 128, 128, 128, 255};
  EXPECT_EQ(cells(kUsual, png.bytes()), "#.?");
  EXPECT_EQ(cells(kUsual + "mode: scale\n", png.bytes()), "???");
}

TEST(MapFile, RawTakesPerCentsAndNothingElse) {
  const std::string raw = kUsual + "mode: raw\n";
  EXPECT_EQ(cells(raw, pgm(8, 1, {0, 19, 20, 65, 66, 100, 101, 255})), "..??##??");
}

TEST(MapFile, WrittenAndReadAgainIsTheSameGrid) {
  RandomStream random(5);
  const std::string folder = testing::TempDir() + "/map_file_test";
  for (const double yaw : {0.0, 0.1 + 0.2, -2.5}) {
    OccupancyGrid grid({{1.0 / 3.0, -1e-7, yaw}, 0.07, 17, 11});
    for (std::size_t i = 0; i < grid.size(); ++i) {
      grid.set(grid.frame().cell(i), static_cast<CellState>(random.below(3)));
    }
    save_map_file(grid, folder + "/it's new/the hall.yaml");
    const OccupancyGrid again = load_map_file(folder + "/it's new/the hall.yaml").grid;
    EXPECT_EQ(again.cells(), grid.cells());
    EXPECT_EQ(again.frame().origin.x_m, grid.frame().origin.x_m);
    EXPECT_EQ(again.frame().origin.y_m, grid.frame().origin.y_m);
    EXPECT_EQ(again.frame().origin.heading_rad, yaw);
    EXPECT_EQ(again.cell_m(), 0.07);
    EXPECT_EQ(again.columns(), 17);
  }
  std::filesystem::remove_all(folder);
}

TEST(MapFile, HashChangesWithEitherFile) {
  const auto hash = [](const std::string& yaml, const std::string& image) {
    return read_map_text(yaml, "m.yaml",
                         [&](const std::string&, std::string&) { return std::optional(image); })
        .content_hash;
  };
  const std::string image = pgm(2, 1, {0, 0});
  EXPECT_EQ(hash(kUsual, image), hash(kUsual, image));
  EXPECT_NE(hash(kUsual, image), hash(kUsual, pgm(2, 1, {0, 1})));
  EXPECT_NE(hash(kUsual, image), hash(kUsual + "\n", image));
}

TEST(MapFile, SaveWantsTheNameOfAYamlFile) {
  const OccupancyGrid grid({{0, 0, 0}, 1.0, 1, 1});
  try {
    save_map_file(grid, "hall.pgm");
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_STREQ(error.what(),
                 "hall.pgm: error: a map is written as a YAML file and an image beside it\n"
                 "  hint: name the YAML file: hall.yaml");
  }
  EXPECT_FALSE(std::filesystem::exists("hall.pgm"));
}

TEST(MapFile, SaysEverythingThatIsWrongAtOnce) {
  EXPECT_EQ(complaint("image: hall.pgm\nresolutoin: 0.5\norigin: [1, x]\nnegate: 2\n"
                      "occupied_thresh: 65\nmode: trinery\n"),
            "maps/hall.yaml: error: key 'resolution' is missing\n"
            "  hint: write resolution: metres per pixel, such as 0.05\n"
            "maps/hall.yaml: error: key 'free_thresh' is missing\n"
            "  hint: write free_thresh: 0.196 is usual\n"
            "maps/hall.yaml:2:1: error: unknown key 'resolutoin'\n"
            "  hint: did you mean 'resolution'?\n"
            "maps/hall.yaml:3:1: error: 'origin' must be three numbers, but has 2\n"
            "  hint: write [x, y, yaw] of the lower left corner: metres and radians\n"
            "maps/hall.yaml:4:9: error: 'negate' must be 0 or 1, but is '2'\n"
            "  hint: 0: black is occupied; 1: white is\n"
            "maps/hall.yaml:5:18: error: 'occupied_thresh' must be a number from 0 to 1, but is "
            "'65'\n"
            "  hint: ROS writes 0.65 for occupied_thresh and 0.196 for free_thresh\n"
            "maps/hall.yaml:6:7: error: there is no mode 'trinery'\n"
            "  hint: did you mean 'trinary'?");
}

TEST(MapFile, RefusesNumbersThatMakeNoMap) {
  for (const char* number : {"0", "-0.05", "nan", ".inf", "1e9", "fine", "''", "~", "0.05 m"}) {
    const std::string said = complaint(with("resolution", "resolution: " + std::string(number)));
    EXPECT_NE(said.find("maps/hall.yaml:2:13: error: 'resolution' must be a number from 0.001 to"),
              std::string::npos)
        << said;
  }
  EXPECT_NE(complaint(with("origin", "origin: [0, 0, north]")).find("3:16: error: yaw of 'origin'"),
            std::string::npos);
  EXPECT_NE(complaint(with("free", "free_thresh: 0.7"))
                .find("6:14: error: 'free_thresh' 0.7 is above 'occupied_thresh' 0.65"),
            std::string::npos);
  EXPECT_NE(complaint(with("resolution", "resolution: [1]")).find("must be a single value"),
            std::string::npos);
}

TEST(MapFile, RefusesWhatIsNoSuchFile) {
  EXPECT_NE(complaint("").find("the file is empty"), std::string::npos);
  EXPECT_NE(complaint("[1, 2]").find("1:1: error: a map's file holds lines `key: value` only"),
            std::string::npos);
  EXPECT_NE(complaint("image: {a: b}").find("1:8: error: a map's file holds"), std::string::npos);
  EXPECT_NE(complaint("image: &a x\nmode: *a").find("an alias is not allowed"), std::string::npos);
  EXPECT_NE(complaint("a: [").find("not valid YAML"), std::string::npos);
  EXPECT_NE(complaint(kUsual + "---\nb: 1").find("second YAML document"), std::string::npos);
  EXPECT_NE(complaint(kUsual + "image: b.pgm").find("7:1: error: key 'image' is written twice"),
            std::string::npos);
  EXPECT_NE(complaint("P5\n1 1\n255\n\x01").find("4:1: error: byte 0x01 is not allowed"),
            std::string::npos);
  EXPECT_NE(complaint(std::string(70'000, ' ')).find("larger than 65536 bytes"), std::string::npos);
}

TEST(MapFile, NamesTheImageThatIsMissingOrBroken) {
  EXPECT_NE(complaint(kUsual, "GIF89a").find("maps/hall.pgm: error: the file is a GIF image"),
            std::string::npos);
  try {
    write_file(testing::TempDir() + "/lonely.yaml", kUsual);
    (void)load_map_file(testing::TempDir() + "/lonely.yaml");
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_EQ(error.diagnostics().at(0).line, 1);
    EXPECT_EQ(error.diagnostics().at(0).column, 8);
    EXPECT_NE(error.diagnostics().at(0).message.find("hall.pgm': No such file"), std::string::npos);
  }
  EXPECT_THROW((void)load_map_file(testing::TempDir() + "/no such file.yaml"), ScenarioError);
  EXPECT_THROW((void)load_map_file(testing::TempDir()), ScenarioError);
}

TEST(MapFile, IsToldFromAScenario) {
  EXPECT_TRUE(looks_like_map_file(kUsual));
  EXPECT_TRUE(looks_like_map_file("image: a.pgm\n"));
  EXPECT_FALSE(looks_like_map_file("schema: line/1\nimage: a.pgm\n"));
  EXPECT_FALSE(looks_like_map_file("schema: line/1\nmap: {occupancy: a.yaml}\n"));
  EXPECT_FALSE(looks_like_map_file("["));
}

}  // namespace
}  // namespace linewright
