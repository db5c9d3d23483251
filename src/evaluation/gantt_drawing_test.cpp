// The SVG and HTML of charts.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "../base/xml_check.hpp"
#include "gantt_labels.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/evaluation/gantt.hpp"
#include "small_log.hpp"

namespace linewright {
namespace {

using test::read_text;
using test::XmlCheck;

GanttChart small_chart() { return make_gantt(read_text(test::small_log())); }

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++found;
  return found;
}

/// A chart in which everything that has a name has a hostile one.
GanttChart hostile_chart() {
  const std::string evil =
      R"(</style></title></script><script>alert(1)</script>\"'><img src=x onerror=alert(2)>&\u0000\ufffe)";
  std::string text = test::small_log();
  for (const std::string name : {"little_line", "human.0", "robot.0", "cage.0", "rack", "desk",
                                 "stock", "box", "press", "punch", "bring", "operate", "punched"}) {
    const std::string from = "\"" + name + "\"";
    const std::string to = "\"" + evil + name + "\"";
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size())) {
      text.replace(at, from.size(), to);
    }
  }
  return make_gantt(read_text(text));
}

/// The chart within the page, which is written as XML too.
std::string drawing_of(const std::string& html) {
  const std::size_t begin = html.find("<svg id=\"chart\"");
  const std::size_t end = html.find("</svg></div>", begin);
  return html.substr(begin, end + 6 - begin);
}

std::string read_file(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(GanttSvg, IsWellFormedAndSelfContained) {
  const std::string svg = gantt_svg(small_chart());
  EXPECT_EQ(XmlCheck::fault(svg), "");
  EXPECT_EQ(count(svg, "<script"), 0U);
  EXPECT_EQ(count(svg, "http"), 1U) << "only the name space";
  EXPECT_EQ(count(svg, "@import") + count(svg, "href"), 0U);
  EXPECT_EQ(count(svg, "prefers-color-scheme:dark"), 1U);
}

TEST(GanttSvg, HasABarWithATitleForEveryInterval) {
  const GanttChart chart = small_chart();
  const std::string svg = gantt_svg(chart);
  for (const GanttSection& section : chart.sections) {
    EXPECT_EQ(count(svg, ">" + section.heading + "<"), 1U);
    for (const GanttRow& row : section.rows) {
      for (const GanttInterval& interval : row.intervals) {
        EXPECT_EQ(count(svg, "<title>" + interval.text + "</title>"), 1U) << interval.text;
      }
    }
  }
  EXPECT_EQ(count(svg, "<title>punched · tick 28</title>"), 1U);
  EXPECT_EQ(count(svg, ">finished 32<"), 1U);
}

TEST(GanttSvg, DrawsTheSameBytesAgain) {
  EXPECT_EQ(gantt_svg(small_chart()), gantt_svg(small_chart()));
  EXPECT_EQ(gantt_html(small_chart()), gantt_html(small_chart()));
}

TEST(GanttSvg, DrawsARunInWhichNothingHappened) {
  std::string text = test::small_log_lines().front() + "\n";
  text += R"({"t":0,"event":"end","status":"deadlock","makespan":null,"progress":0})";
  const GanttChart chart = make_gantt(read_text(text));
  EXPECT_EQ(XmlCheck::fault(gantt_svg(chart)), "");
  EXPECT_EQ(XmlCheck::fault(gantt_svg(GanttChart{})), "");
  EXPECT_EQ(XmlCheck::fault(drawing_of(gantt_html(GanttChart{}))), "");
}

TEST(GanttSvg, DrawsTheLongestRunWithFewGridLines) {
  GanttChart chart = small_chart();
  chart.last = kMaxTicks;
  EXPECT_LT(count(gantt_svg(chart), "class=\"grid\""), 30U);
}

TEST(GanttSvg, TellsMoreTasksApartThanThereAreColours) {
  GanttChart chart = small_chart();
  for (int i = 0; i < 60; ++i) chart.tasks.push_back({i + 3, "task_" + std::to_string(i)});
  chart.sections[0].rows[0].intervals.back().task = chart.tasks.size() - 1;
  const std::string svg = gantt_svg(chart);
  EXPECT_EQ(XmlCheck::fault(svg), "");
  EXPECT_EQ(count(svg, ">task_59<"), 1U);
}

TEST(GanttSvg, EscapesHostileNames) {
  const std::string svg = gantt_svg(hostile_chart());
  EXPECT_EQ(XmlCheck::fault(svg), "");
  EXPECT_EQ(count(svg, "<script") + count(svg, "<img"), 0U);
  EXPECT_GT(count(svg, "&lt;script&gt;alert(1)"), 5U);
}

TEST(GanttHtml, IsSelfContainedAndForbidsAllElse) {
  const std::string html = gantt_html(small_chart());
  EXPECT_EQ(XmlCheck::fault(drawing_of(html)), "");
  EXPECT_EQ(count(html, "<script"), 1U);
  EXPECT_EQ(count(html, "default-src 'none'"), 1U);
  EXPECT_EQ(count(html, "src=\"") + count(html, "href"), 0U);
  EXPECT_EQ(count(html, "innerHTML") + count(html, "eval("), 0U);
}

TEST(GanttHtml, EscapesHostileNames) {
  const std::string html = gantt_html(hostile_chart());
  EXPECT_EQ(XmlCheck::fault(drawing_of(html)), "");
  EXPECT_EQ(count(html, "<script"), 1U);
  EXPECT_EQ(count(html, "</script"), 1U);
  EXPECT_EQ(count(html, "</style"), 1U);
  EXPECT_EQ(count(html, "<img"), 0U);
}

TEST(GanttHtml, HasAButtonForEveryTask) {
  EXPECT_EQ(count(gantt_html(small_chart()), "<button type=\"button\" data-task="), 2U);
}

TEST(GanttLabels, PutATasksNameOverItsLongestWork) {
  const auto labels = gantt::labels_of(small_chart().sections[0].rows[0]);
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_EQ(labels[0].begin, 10);  // both items together
  EXPECT_EQ(labels[0].end, 16);
  EXPECT_EQ(labels[0].words, "bring");
}

TEST(GanttLabels, DoNotRepeatWhichMachineItIs) {
  GanttRow row{"welder.inner", {{0, 9, GanttKind::kWorking, {}, 0, "weld.inner", "x"}}};
  EXPECT_EQ(gantt::labels_of(row).at(0).words, "weld");
  row.name = "gantry";
  EXPECT_EQ(gantt::labels_of(row).at(0).words, "weld.inner");
}

TEST(GanttLabels, ShowWhatFits) {
  EXPECT_EQ(gantt::fitting("bring_flanges", "1", 200), "bring_flanges");
  EXPECT_EQ(gantt::fitting("bring_flanges", "1", 40), "1");
  EXPECT_EQ(gantt::fitting("bring_flanges", "1", 4), "");
  EXPECT_EQ(gantt::fitting("weld", "", 10), "");
}

TEST(GanttLabels, StandOnRoundTicks) {
  EXPECT_EQ(gantt::grid_step(745, 1300), 50);
  EXPECT_EQ(gantt::grid_step(2000, 1300), 100);
  EXPECT_EQ(gantt::grid_step(7, 1300), 1);
  EXPECT_EQ(gantt::grid_step(1, 1300), 1);
}

class GanttFile : public testing::Test {
 protected:
  GanttFile() : folder_(testing::TempDir() + "linewright_gantt_file_" + std::to_string(getpid())) {
    std::filesystem::remove_all(folder_);
  }
  ~GanttFile() override { std::filesystem::remove_all(folder_); }

  std::string folder_;
};

TEST_F(GanttFile, IsWrittenByItsExtension) {
  write_gantt(small_chart(), folder_ + "/new/chart.svg");
  write_gantt(small_chart(), folder_ + "/new/chart.html");
  EXPECT_EQ(read_file(folder_ + "/new/chart.svg"), gantt_svg(small_chart()));
  EXPECT_EQ(read_file(folder_ + "/new/chart.html"), gantt_html(small_chart()));
  const auto files = std::filesystem::directory_iterator(folder_ + "/new");
  EXPECT_EQ(std::distance(begin(files), end(files)), 2) << "nothing is left beside them";
}

TEST_F(GanttFile, HasAKnownExtension) {
  for (const std::string name : {"/chart.pdf", "/chart", "/svg", "/chart.SVG.txt"}) {
    EXPECT_THROW(write_gantt(small_chart(), folder_ + name), ScenarioError) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_));
}

TEST_F(GanttFile, MustBeWritable) {
  EXPECT_THROW(write_gantt(small_chart(), "/proc/chart.svg"), ScenarioError);
  EXPECT_THROW(write_gantt(small_chart(), "/dev/null/chart.svg"), ScenarioError);
  std::filesystem::create_directories(folder_ + "/chart.svg");
  EXPECT_THROW(write_gantt(small_chart(), folder_ + "/chart.svg"), ScenarioError);
}

}  // namespace
}  // namespace linewright
