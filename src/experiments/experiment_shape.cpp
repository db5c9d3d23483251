#include "experiment_shape.hpp"

#include <utility>
#include <vector>

#include "linewright/experiments/experiment.hpp"
#include "linewright/scenario/shape_makers.hpp"

namespace linewright::experiments {
namespace {

using loading::Field;
using loading::key;
using loading::required;
using loading::ShapePtr;
using Kind = loading::Shape::Kind;

constexpr std::int64_t kMostTrials = 1'000'000;
constexpr std::int64_t kMostSeed = 1'000'000'000;
constexpr std::size_t kMostSeeds = 100;
constexpr std::size_t kMostRows = 64;
constexpr std::size_t kMostOrders = 100;
constexpr std::size_t kMostOptions = 100;

ShapePtr text(const char* expected) { return loading::scalar(Kind::kText, expected); }
ShapePtr name(const char* expected) { return loading::scalar(Kind::kName, expected); }

ShapePtr row_shape() {
  return loading::mapping(
      "a mapping {row: EBQ-N, algorithm: ebq-n}",
      {required("row", name("the row's name"), ""),
       key("algorithm", text("an algorithm: a name of the folder algorithms/, or a file"), ""),
       key("set",
           loading::list(text("an option, such as buffer.copies=1"),
                         "a list of options, such as [buffer.copies=1]", 1, kMostOptions),
           ""),
       key("planner", text("a planner, such as first or priority:tuned"), ""),
       key("bound", loading::choice({"combined"}), ""), key("allocator", name("an allocator"), ""),
       key("paper", name("a row of the paper's table"), ""),
       key("trials", loading::integer(1, kMostTrials), "")});
}

ShapePtr claim_shape() {
  return loading::mapping(
      "a mapping {says: ..., lower: ROW, than: ROW}",
      {required("says", text("a sentence"), ""), required("lower", name("a row"), ""),
       required("than", name("a row"), ""), key("metric", loading::choice(metric_names()), ""),
       key("column", name("a column"), "")});
}

/// All but those of training, which an experiment with `columns: training` has by itself.
std::vector<std::string> metrics_of_runs() {
  std::vector<std::string> names = metric_names();
  names.pop_back();
  return names;
}

ShapePtr seeds_shape() {
  return loading::list(loading::integer(0, kMostSeed), "a list of seeds", 1, kMostSeeds);
}

}  // namespace

const loading::Shape& experiment_shape() {
  static const loading::Shape kShape = *loading::mapping(
      "a mapping",
      {required("title", text("a title"), ""), key("about", text("some sentences"), ""),
       required("scenario", text("a scenario file"), ""),
       key("trained_on", text("a scenario file"), ""),
       key("paper", name("a table of the paper"), ""),
       key("paper_tables", text("a file with the paper's tables"), ""),
       key("base", name("a row"), ""),
       required("columns", loading::choice({"crews", "orders", "training"}), ""),
       key("orders",
           loading::list(loading::integer(1, 1'000'000), "a list of quantities", 1, kMostOrders),
           ""),
       key("metrics",
           loading::list(loading::choice(metrics_of_runs()), "a list of metrics", 1,
                         metrics_of_runs().size()),
           ""),
       required("rows", loading::list(row_shape(), "a list of rows", 1, kMostRows), ""),
       key("claims", loading::list(claim_shape(), "a list of claims"), ""),
       key("seeds", seeds_shape(), ""), key("trials", loading::integer(1, kMostTrials), ""),
       key("starts_seed", loading::integer(0, kMostSeed), ""),
       key("shield", loading::scalar(Kind::kBoolean, "true or false"), ""),
       key("horizon",
           loading::one_of({loading::choice({"scenario"}), loading::integer(1, kMaxTicks)}), ""),
       key("quick",
           loading::mapping("a mapping {seeds: [1], trials: 5}",
                            {key("seeds", seeds_shape(), ""),
                             key("trials", loading::integer(1, kMostTrials), "")}),
           "")});
  return kShape;
}

}  // namespace linewright::experiments
