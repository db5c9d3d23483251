#include <fmt/format.h>

#include <algorithm>

#include "cases.hpp"
#include "linewright/routing/hybrid_a_star.hpp"
#include "ompl_planners.hpp"
#include "plain_hybrid_a_star.hpp"
#include "report.hpp"
#include "sections.hpp"

namespace linewright::bench {
namespace {

struct Ours {
  Query query;
  double cold_s;
  double warm_s;  ///< the same query again
  double metres;
};

/// The queries that ours finds a way for, and those that it does not, by count.
struct Base {
  std::vector<Ours> found;
  std::size_t failed = 0;
};

Base plan_all(const Case& c) {
  Base base;
  for (const Query& query : c.queries) {
    const double start = cpu_s();
    HybridAStar planner(c.map, c.mover);
    const Path path = planner.plan(query.start, query.goal);
    const double cold_s = cpu_s() - start;
    const double again = cpu_s();
    (void)planner.plan(query.start, query.goal);
    const double warm_s = cpu_s() - again;
    if (path.found()) {
      base.found.push_back({query, cold_s, warm_s, path.metres()});
    } else {
      ++base.failed;
    }
  }
  return base;
}

using Rows = std::vector<std::vector<std::string>>;

std::vector<std::string> row(const std::string& name, const Base& base,
                             const std::vector<double>& times, const std::vector<double>& lengths) {
  return {name,
          fmt::format("{} of {}", lengths.size(), base.found.size()),
          fmt::format("{:.1f}", quantile(times, 0.5)),
          fmt::format("{:.1f}", mean_of(times)),
          lengths.empty() ? "-" : fmt::format("{:.3f}", mean_of(lengths)),
          lengths.empty() ? "-" : fmt::format("{:.3f}", quantile(lengths, 1.0))};
}

/// Two rows: cold beside ours cold, and the same query again beside ours again.
void add_plain(Rows& rows, const Case& c, const Base& base, double greed) {
  PathPlannerOptions options;
  options.greed = greed;
  std::vector<double> cold;
  std::vector<double> warm;
  std::vector<double> lengths;
  for (const Ours& ours : base.found) {
    double start = cpu_s();
    PlainHybridAStar plain(c, options);
    const Path path = plain.plan(ours.query);
    cold.push_back((cpu_s() - start) / ours.cold_s);
    start = cpu_s();
    (void)plain.plan(ours.query);
    warm.push_back((cpu_s() - start) / ours.warm_s);
    if (path.found()) lengths.push_back(path.metres() / ours.metres);
  }
  rows.push_back(row(fmt::format("textbook, greed {}", greed), base, cold, lengths));
  rows.push_back(row("  the same again, ours too", base, warm, lengths));
}

void add_ompl(Rows& rows, const Case& c, const Base& base, const std::string& planner,
              double factor) {
  std::vector<double> times;
  std::vector<double> lengths;
  for (const Ours& ours : base.found) {
    const double start = cpu_s();
    const auto metres = ompl_path_m(planner, c, ours.query, factor * ours.cold_s);
    times.push_back((cpu_s() - start) / ours.cold_s);
    if (metres) lengths.push_back(*metres / ours.metres);
  }
  rows.push_back(
      row(fmt::format("OMPL {}, {:.0f} x our time", planner, factor), base, times, lengths));
}

void compare(const Case& c) {
  const Base base = plan_all(c);
  std::vector<double> cold;
  for (const Ours& ours : base.found) cold.push_back(ours.cold_s);
  Rows rows{{fmt::format("{}: ours {} of {} found, {:.1f} ms median", c.name, base.found.size(),
                         c.queries.size(), 1e3 * quantile(cold, 0.5)),
             "found", "time, median", "time, mean", "length, mean", "length, worst"}};
  const PathPlannerOptions options;
  add_plain(rows, c, base, options.greed);
  add_plain(rows, c, base, 1.0);
  for (const std::string& planner : ompl_planners()) {
    for (const double factor : {1.0, 10.0, 100.0}) add_ompl(rows, c, base, planner, factor);
  }
  print_table(rows);
  fmt::print("\n");
}

}  // namespace

void compare_planners(bool thorough) {
  print_title("Beside other planners",
              "The same queries, cold; times and lengths as ratios to ours on the queries that "
              "ours finds a way for.");
  if (ompl_planners().empty()) fmt::print("  (OMPL is not installed: left out)\n\n");
  const DuctHall hall = duct_hall();
  compare(hall_case(hall, hall.requests.back(), thorough ? 3 : 13));
  const std::size_t queries = thorough ? 20 : 5;
  for (const std::size_t percent : {10, 20}) {
    compare(random_case(384, percent, long_robot(), queries));
  }
}

}  // namespace linewright::bench
