#include "linewright/evaluation/hall_picture.hpp"

#include <gtest/gtest.h>

#include <set>

#include "../base/xml_check.hpp"
#include "hall_floor.hpp"
#include "hall_marks.hpp"
#include "small_log.hpp"

namespace linewright {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

std::string picture(const std::string& text, Tick tick) {
  return hall_picture(test::read_text(text), tick);
}

TEST(HallPicture, IsWellFormedAtEveryTickAndTheSameEachTime) {
  const LogDocument log = test::read_text(test::small_log());
  for (Tick tick = 0; tick <= 33; ++tick) {
    const std::string svg = hall_picture(log, tick);
    EXPECT_EQ(test::XmlCheck::fault(svg), "") << tick;
    EXPECT_EQ(svg, hall_picture(log, tick)) << tick;
  }
}

TEST(HallPicture, ShowsEveryWorkerAndSaysWhatItDoes) {
  const std::string svg = picture(test::small_log(), 4);
  EXPECT_EQ(count(svg, "<g class=\"worker\""), 2U);
  EXPECT_NE(svg.find("little_line at tick 4"), std::string::npos);
  EXPECT_NE(svg.find("bring: walk desk → rack"), std::string::npos);
  EXPECT_NE(svg.find("2/4 ticks"), std::string::npos);
  EXPECT_NE(svg.find("0 of 2 × box finished"), std::string::npos);
  EXPECT_EQ(count(svg, "class=\"ahead k0\""), 2U);  // both are on their way for `bring`
}

TEST(HallPicture, DrawsALogWithoutAHallAroundItsStations) {
  const std::string header = "\"hall\":{\"bounds\"";
  const LogDocument log = test::read_text(test::small_log_with(header, "\"no\":{\"bounds\""));
  ASSERT_FALSE(log.header.hall);
  const Rectangle floor = hall::floor_of(log.header);
  EXPECT_LT(floor.x0_m, 0.0);
  EXPECT_GT(floor.y1_m, 6.0);
  EXPECT_EQ(test::XmlCheck::fault(hall_picture(log, 4)), "");
}

TEST(HallPicture, StationsOnALineAndNoStationsAtAllHaveAFloor) {
  LogHeader header;
  Rectangle floor = hall::floor_of(header);
  EXPECT_LT(floor.x0_m, floor.x1_m);
  EXPECT_LT(floor.y0_m, floor.y1_m);
  header.stations = {{"a", {{"human", {0, 5, 0}}}}, {"b", {{"human", {40, 5, 0}}}}};
  floor = hall::floor_of(header);
  EXPECT_GT(floor.y1_m - floor.y0_m, 5.0);
  EXPECT_LT(floor.y1_m - floor.y0_m, 15.0);
}

TEST(HallPicture, MarksClosedZones) {
  EXPECT_EQ(count(picture(test::zones_log(), 3), "class=\"zone shut\""), 0U);
  EXPECT_EQ(count(picture(test::zones_log(), 5), "class=\"zone shut\""), 1U);
}

TEST(HallPicture, DrawsMachinesWhoseAreaIsKnownWithTheirProgress) {
  const std::string with = test::small_log_with(
      "\"operations\":", R"("machine_areas":{"press":[[2,2],[4,2],[4,3],[2,3]]},"operations":)");
  const std::string working = picture(with, 25);
  EXPECT_EQ(count(working, "<title>press</title>"), 1U);
  EXPECT_EQ(count(working, "<title>clamp</title>"), 0U);  // nobody knows where it is
  EXPECT_EQ(count(working, "class=\"done\""), 1U);
  EXPECT_EQ(count(picture(with, 3), "class=\"done\""), 0U);
}

TEST(HallPicture, NamesInTheLogStayText) {
  const std::string name = "<script>alert(1)</script>";
  const std::string svg = picture(test::small_log_with("little_line", name), 4);
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  EXPECT_NE(svg.find("&lt;script&gt;"), std::string::npos);
}

TEST(HallPicture, ManyWorkersAtOnePlaceStandSideBySide) {
  std::string many;
  for (int i = 1; i < 30; ++i) {
    many += R"(,{"id":"human.)" + std::to_string(i) + R"(","kind":"human","start":"desk"})";
  }
  const std::string text = test::small_log_with(R"("kind":"human","start":"desk"})",
                                                R"("kind":"human","start":"desk"})" + many);
  const std::string svg = picture(text, 1);
  EXPECT_EQ(count(svg, "<g class=\"worker\""), 31U);
  std::set<std::string> spots;
  for (std::size_t at = svg.find("<g class=\"worker\""); at != std::string::npos;
       at = svg.find("<g class=\"worker\"", at + 1)) {
    spots.insert(svg.substr(at, svg.find(')', at) - at));
  }
  EXPECT_EQ(spots.size(), 31U);
}

TEST(TokenMark, ShowsFewAsSquaresAndManyAsANumber) {
  EXPECT_EQ(count(hall::TokenMark{3, 4}.svg(), "class=\"full\""), 3U);
  EXPECT_EQ(count(hall::TokenMark{3, 4}.svg(), "class=\"hole\""), 1U);
  EXPECT_NE((hall::TokenMark{12, std::nullopt}.svg().find(">12<")), std::string::npos);
  EXPECT_EQ(count(hall::TokenMark{7, 4}.svg(), "<rect"), 4U);
}

}  // namespace
}  // namespace linewright
