#include <fmt/format.h>

#include <algorithm>

#include "common.hpp"
#include "evaluation.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;

Spread makespan_over(const SeedGroup& group) {
  return group.over_seeds([](const Evaluation& seed) { return seed.makespan(); });
}

Spread success_over(const SeedGroup& group) {
  return group.over_seeds([](const Evaluation& seed) { return seed.success_rate(); });
}

Spread makespan_over(const SeedGroup& group, std::size_t crew) {
  return group.over_seeds([&](const Evaluation& seed) { return seed.rows[crew].makespan.mean; });
}

/// Two rows: the means, and below each the half-width of its interval.
void add_rows(const std::vector<SeedGroup>& groups, const SeedGroup& group,
              std::vector<std::vector<std::string>>& rows) {
  std::vector<std::string> means{group.folder, group.allocator, std::to_string(group.seeds.size())};
  std::vector<std::string> intervals{"", "+-", ""};
  const auto add = [&](std::string mean, double interval) {
    means.push_back(std::move(mean));
    intervals.push_back(group.seeds.size() > 1 ? fmt::format("{:.1f}", interval) : "");
  };
  for (std::size_t crew = 0; crew < group.seeds[0]->rows.size(); ++crew) {
    const Spread spread = makespan_over(group, crew);
    add(fmt::format("{:.1f}", spread.mean), spread.ci95);
  }
  const Spread mean = makespan_over(group);
  add(fmt::format("{:.1f}", mean.mean), mean.ci95);
  if (&group == &groups[0]) {
    means.emplace_back();
    intervals.emplace_back();
  } else {
    const MeanDifference difference = welch_difference(makespan_over(groups[0]), mean);
    add(fmt::format("{:+.1f}", difference.mean), difference.ci95);
  }
  means.push_back(fmt::format("{:.3f}", success_over(group).mean));
  intervals.emplace_back();
  rows.push_back(std::move(means));
  rows.push_back(std::move(intervals));
}

}  // namespace

Spread SeedGroup::over_seeds(const std::function<double(const Evaluation&)>& value) const {
  std::vector<double> values;
  for (const Evaluation* seed : seeds) values.push_back(value(*seed));
  return spread_of(values);
}

std::vector<SeedGroup> seed_groups(const std::vector<Evaluation>& evaluations) {
  std::vector<SeedGroup> groups;
  for (const Evaluation& evaluation : evaluations) {
    if (evaluation.folder.empty()) continue;
    const std::string& allocator = evaluation.configuration.allocator;
    auto group = std::find_if(groups.begin(), groups.end(), [&](const SeedGroup& g) {
      return g.folder == evaluation.folder && g.allocator == allocator;
    });
    if (group == groups.end()) {
      group = groups.insert(group, {.folder = evaluation.folder, .allocator = allocator});
    }
    group->seeds.push_back(&evaluation);
  }
  return groups;
}

std::string seeds_text(const LineModel& line, const std::vector<Evaluation>& evaluations) {
  const std::vector<SeedGroup> groups = seed_groups(evaluations);
  if (groups.empty()) return {};
  std::vector<std::vector<std::string>> rows{{"training seeds of", "allocator", "seeds"}};
  for (const TrialSummary& row : groups[0].seeds[0]->rows) {
    rows[0].push_back(crew_name(line, row.crew));
  }
  for (const char* title : {"mean", "difference", "success"}) rows[0].emplace_back(title);
  for (const SeedGroup& group : groups) add_rows(groups, group, rows);
  return "\nmean makespan over training seeds, below it the half-width of its 95 % interval; "
         "difference to the first of these (Welch)\n" +
         text_table(rows);
}

nlohmann::ordered_json seeds_json(const LineModel& line,
                                  const std::vector<Evaluation>& evaluations) {
  const auto value_of = [](const Spread& spread) {
    return Json{{"mean", spread.mean}, {"sd", spread.sd}, {"ci95", spread.ci95}};
  };
  Json list = Json::array();
  const std::vector<SeedGroup> groups = seed_groups(evaluations);
  for (const SeedGroup& group : groups) {
    Json& entry = list.emplace_back(Json{{"planner", group.folder},
                                         {"allocator", group.allocator},
                                         {"seeds", group.seeds.size()},
                                         {"makespan", value_of(makespan_over(group))},
                                         {"success_rate", value_of(success_over(group))},
                                         {"crews", Json::array()}});
    for (std::size_t c = 0; c < group.seeds[0]->rows.size(); ++c) {
      entry["crews"].push_back({{"crew", crew_name(line, group.seeds[0]->rows[c].crew)},
                                {"makespan", value_of(makespan_over(group, c))}});
    }
    if (&group == &groups[0]) continue;
    const MeanDifference difference =
        welch_difference(makespan_over(groups[0]), makespan_over(group));
    entry["difference"] = {{"minus", groups[0].folder + "+" + groups[0].allocator},
                           {"mean", difference.mean},
                           {"ci95", difference.ci95}};
  }
  return list;
}

}  // namespace linewright::cli
