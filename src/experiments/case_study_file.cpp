#include <fmt/format.h>

#include <filesystem>

#include "linewright/base/files.hpp"
#include "linewright/experiments/case_study.hpp"
#include "linewright/scenario/shape_check.hpp"
#include "linewright/scenario/shape_makers.hpp"
#include "linewright/scenario/source_files.hpp"
#include "linewright/scenario/values.hpp"

namespace linewright {
namespace {

using loading::key;
using loading::Problems;
using loading::required;
using loading::ShapePtr;
using loading::SourceEntry;
using loading::SourceNode;
using Kind = loading::Shape::Kind;

constexpr std::int64_t kMostSeed = 1'000'000'000;
constexpr std::size_t kMostMarks = 26;
constexpr std::size_t kMostRows = 10;

ShapePtr text(const char* expected) { return loading::scalar(Kind::kText, expected); }
ShapePtr name(const char* expected) { return loading::scalar(Kind::kName, expected); }

ShapePtr row_shape() {
  return loading::mapping(
      "a mapping {row: EBQ-N, algorithm: ebq-n, seed: 1}",
      {required("row", name("the row's name"), ""),
       key("algorithm", text("an algorithm: a name of the folder algorithms/, or a file"), ""),
       key("seed", loading::integer(0, kMostSeed), ""), key("planner", text("a planner"), ""),
       key("decisions", text("a file of recorded decisions"), ""),
       key("allocator", name("an allocator"), "")});
}

ShapePtr mark_shape() {
  return loading::mapping(
      "a mapping {mark: a, task: TASK, nth: 1, says: ...}",
      {required("mark", name("a letter"), ""), required("task", name("a task"), ""),
       key("nth", loading::integer(1, 100'000), ""), key("says", text("a sentence"), "")});
}

const loading::Shape& case_shape() {
  static const loading::Shape kShape = *loading::mapping(
      "a mapping",
      {required("kind", loading::choice({"case_study"}), ""),
       required("title", text("a title"), ""), key("about", text("some sentences"), ""),
       required("scenario", text("a scenario file"), ""),
       key("trained_on", text("a scenario file"), ""),
       required("order", loading::integer(1, 1'000'000), ""),
       required("starts",
                loading::names_to(loading::list(name("a station"), "a list of stations", 1),
                                  "a mapping from kinds of workers and carriers to stations"),
                ""),
       required("rows", loading::list(row_shape(), "a list of rows", 1, kMostRows), ""),
       key("marks", loading::list(mark_shape(), "a list of marks", 0, kMostMarks), "")});
  return kShape;
}

const loading::Shape& showcase_shape() {
  static const loading::Shape kShape =
      *loading::mapping("a mapping", {required("kind", loading::choice({"routes"}), ""),
                                      required("title", text("a title"), ""),
                                      key("about", text("some sentences"), ""),
                                      required("scenario", text("a scenario file"), "")});
  return kShape;
}

SourceNode checked(const std::string& file, const loading::Shape& shape, const char* what) {
  Problems problems;
  SourceNode root = loading::read_files(file, problems);
  problems.throw_if_any();
  loading::check_shape(root, shape, problems, what);
  problems.throw_if_any();
  return root;
}

CaseRow read_row(const SourceNode& node, const std::string& file, Problems& problems) {
  CaseRow row{.who = {.name = loading::text_or(node, "row", ""),
                      .algorithm = loading::text_or(node, "algorithm", ""),
                      .planner = loading::text_or(node, "planner", ""),
                      .allocator = loading::text_or(node, "allocator", "sap"),
                      .trials = {}},
              .decisions = loading::text_or(node, "decisions", ""),
              .seed = static_cast<std::uint64_t>(loading::integer_or(node, "seed", 1))};
  const int ways = static_cast<int>(!row.who.algorithm.empty()) +
                   static_cast<int>(!row.who.planner.empty()) +
                   static_cast<int>(!row.decisions.empty());
  if (ways != 1) {
    problems.error(node.mark,
                   fmt::format("row {} must have either an algorithm or a planner or decisions",
                               in_quotes(row.who.name)),
                   "write one of the three");
  }
  if (row.who.algorithm.ends_with(".yaml")) row.who.algorithm = beside(file, row.who.algorithm);
  if (!row.decisions.empty()) row.decisions = beside(file, row.decisions);
  return row;
}

CaseMark read_mark(const SourceNode& node) {
  return {.mark = loading::text_or(node, "mark", ""),
          .task = loading::text_or(node, "task", ""),
          .nth = loading::integer_or(node, "nth", 1),
          .says = loading::text_or(node, "says", "")};
}

}  // namespace

std::string kind_of_study(const std::string& file) {
  Problems problems;
  return loading::text_or(loading::read_files(file, problems), "kind", "");
}

RouteShowcase load_route_showcase(const std::string& file) {
  const SourceNode root = checked(file, showcase_shape(), "the route showcase");
  return {.name = std::filesystem::path(file).stem().string(),
          .title = loading::text_or(root, "title", ""),
          .about = loading::text_or(root, "about", ""),
          .scenario = beside(file, loading::text_or(root, "scenario", ""))};
}

CaseStudy load_case_study(const std::string& file) {
  const SourceNode root = checked(file, case_shape(), "the case study");
  Problems problems;
  problems.add_file(file);
  const std::string scenario = loading::text_or(root, "scenario", "");
  CaseStudy study{.name = std::filesystem::path(file).stem().string(),
                  .title = loading::text_or(root, "title", ""),
                  .about = loading::text_or(root, "about", ""),
                  .scenario = beside(file, scenario),
                  .trained_on = beside(file, loading::text_or(root, "trained_on", scenario)),
                  .order = loading::integer_or(root, "order", 1)};
  for (const SourceEntry& entry : root.find("starts")->entries) {
    for (const SourceNode& station : entry.value.items) {
      study.starts[entry.key].push_back(station.text);
    }
  }
  for (const SourceNode& node : root.find("rows")->items) {
    study.rows.push_back(read_row(node, file, problems));
  }
  if (const SourceNode* marks = root.find("marks")) {
    for (const SourceNode& node : marks->items) study.marks.push_back(read_mark(node));
  }
  problems.throw_if_any();
  return study;
}

}  // namespace linewright
