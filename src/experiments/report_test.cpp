#include "linewright/experiments/report.hpp"

#include <gtest/gtest.h>

#include <regex>

#include "linewright/experiments/render.hpp"

namespace linewright {
namespace {

/// Two rows by two crews, with numbers that look different with and without decimals.
ExperimentResult sample(const std::string& base = "", double shift = 0.0) {
  Experiment experiment{.name = "test", .title = "Title <b>", .about = "About & so on"};
  experiment.base = base;
  experiment.orders = {5};
  experiment.metrics = {Metric::kMakespan, Metric::kSuccessRate, Metric::kDistance};
  experiment.rows = {{.name = "A<script>", .algorithm = "a"},
                     {.name = "B", .planner = "b"},
                     {.name = "C", .bound = "combined"}};
  experiment.claims = {{.says = "A is \"faster\"", .lower = "A<script>", .than = "B"}};
  experiment.trials = 2;
  const auto cell = [&](double plus) {
    const auto at = [&](double value) { return static_cast<Tick>(value + plus + shift); };
    CellResult result;
    result.crews = {{"H1R1", {at(100), at(111)}, {1, 1}, {1, 1}, {10, 21}},
                    {"H1R2", {at(200), at(220)}, {1, 0}, {1, 0.5}, {30, 40}}};
    return result;
  };
  CellResult bound;
  bound.crews = {{.name = "H1R1", .makespan = {90}}, {.name = "H1R2", .makespan = {180}}};
  return make_tables(experiment, {{{cell(0)}, {cell(7)}}, {{cell(30)}}, {{bound}}});
}

std::string page(const ExperimentResult& result) {
  Report report{.title = "A report & more",
                .summary = "Summary",
                .facts = {{"Command", "x --out '<y>'"}},
                .sections = {section_of(result, table_figures(result, {}))}};
  report.sections[0].figures.push_back(
      {.figure = {.name = "own", .caption = "Own <i>", .svg = "<svg>own</svg>"},
       .own_style = true});
  return report_html(report);
}

TEST(Report, EscapesAllText) {
  const std::string html = page(sample());
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("<b>"), std::string::npos);
  EXPECT_NE(html.find("A&lt;script&gt;"), std::string::npos);
  EXPECT_NE(html.find("About &amp; so on"), std::string::npos);
  EXPECT_NE(html.find("x --out &#39;&lt;y&gt;&#39;"), std::string::npos) << html;
}

TEST(Report, NeedsNothingElse) {
  const std::string html = page(sample());
  for (const char* outside : {"http://", "https://", "<link", "@import", "url("}) {
    std::string rest = html;
    // The name of SVG's language is no address that anybody opens.
    const std::string name = "http://www.w3.org/2000/svg";
    for (std::size_t at = rest.find(name); at != std::string::npos; at = rest.find(name)) {
      rest.erase(at, name.size());
    }
    EXPECT_EQ(rest.find(outside), std::string::npos) << outside;
  }
  EXPECT_NE(html.find("src=\"data:image/svg+xml;base64,PHN2Zz5vd248L3N2Zz4=\""), std::string::npos);
}

/// The first number of every cell of the tables whose rows are ours, metric by metric.
std::vector<std::string> numbers_in(const std::string& html) {
  std::vector<std::string> numbers;
  const std::regex row("<tr><th scope=\"row\">(A&lt;script&gt;|B|C)</th>(.*)</tr>");
  const std::regex cell("<td>([0-9.]*)[^<]*</td>");
  for (std::sregex_iterator r(html.begin(), html.end(), row), end; r != end; ++r) {
    const std::string cells = (*r)[2];
    for (std::sregex_iterator c(cells.begin(), cells.end(), cell); c != end; ++c) {
      numbers.push_back((*c)[1]);
    }
    numbers.pop_back();  // "2 seeds"
  }
  return numbers;
}

TEST(Report, AgreesWithTheCsv) {
  const ExperimentResult result = sample();
  std::vector<std::string> expected;
  std::istringstream csv(result_csv(result));
  std::string line;
  std::getline(csv, line);
  while (std::getline(csv, line)) {
    std::vector<std::string> fields;
    std::istringstream in(line);
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
    const int decimals = fields[1] == "success_rate" ? 3 : 1;
    if (fields[2] == "C" && fields[1] != "makespan") continue;  // a bound has nothing else
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", decimals, std::stod(fields[4]));
    expected.emplace_back(text);
  }
  EXPECT_EQ(expected.size(), 3U * 7U);
  EXPECT_EQ(numbers_in(page(result)), expected);
}

TEST(Report, HasContentsFiguresAndVerdicts) {
  const std::string html = page(sample());
  EXPECT_NE(html.find("<a href=\"#section-1\">Title &lt;b&gt;</a>"), std::string::npos);
  EXPECT_NE(html.find("<section id=\"section-1\">"), std::string::npos);
  EXPECT_NE(html.find("<td class=\"open\">open</td>"), std::string::npos) << html;
  EXPECT_NE(html.find("over seeds and starts"), std::string::npos);
  std::size_t figures = 0;
  for (std::size_t at = html.find("<figure"); at != std::string::npos;
       at = html.find("<figure", at + 1)) {
    ++figures;
  }
  EXPECT_EQ(figures, 4U);
}

TEST(Improvements, AreOverTheBaseAndTheBetterWay) {
  const Improvements improvements = improvements_of({sample("B")});
  EXPECT_EQ(improvements.base, "B");
  // Successes do not differ, and bounds have no distance: they are no rows here.
  EXPECT_EQ(improvements.axes, (std::vector<std::string>{"makespan"}));
  ASSERT_EQ(improvements.rows.size(), 1U);
  EXPECT_EQ(improvements.rows[0].name, "A<script>");
  const double a = (105.5 + 210.0) / 2 + 3.5;
  const double b = (105.5 + 210.0) / 2 + 30.0;
  EXPECT_NEAR(improvements.rows[0].percent.at(0), 100.0 * (b - a) / b, 1e-9);
  EXPECT_NE(improvement_figure(improvements, {}).svg.find("<svg"), std::string::npos);
  EXPECT_TRUE(improvements_of({sample("")}).axes.empty());
}

TEST(Improvements, PutSeveralExperimentsTogether) {
  ExperimentResult other = sample("B", 50.0);
  other.experiment.base = "B";
  const Improvements improvements = improvements_of({sample("B"), other, sample("A<script>")});
  EXPECT_EQ(improvements.axes.size(), 2U);
  const ReportSection section = section_of(improvements, {});
  EXPECT_EQ(section.tables.at(0).rows.size(), 1U);
  EXPECT_EQ(section.figures.size(), 1U);
}

TEST(Styles, AreTheSameInAllPictures) {
  Experiment first;
  first.rows = {{.name = "A"}, {.name = "B"}};
  Experiment second;
  second.rows = {{.name = "C"}, {.name = "B"}};
  const RowStyles styles = styles_of({first, second});
  EXPECT_EQ(styles, (RowStyles{{"A", 0}, {"B", 1}, {"C", 2}}));
}

}  // namespace
}  // namespace linewright
