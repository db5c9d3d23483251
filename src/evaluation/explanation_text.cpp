#include "linewright/evaluation/explanation_text.hpp"

#include <fmt/format.h>

#include <vector>

#include "linewright/evaluation/event_log_writer.hpp"

namespace linewright {
namespace {

/// What the text calls everybody.
struct Names {
  std::vector<std::string> workers;
  std::vector<std::string> carriers;
};

std::string crew_text(const LineModel& line, const Names& names_of, const Assignment& assignment) {
  std::vector<std::string> names;
  const auto& crew = line.tasks[assignment.task.index()].crew;
  for (std::size_t slot = 0; slot < crew.size(); ++slot) {
    if (assignment.members[slot] < 0) {
      names.push_back(fmt::format("a {} later", crew[slot].role));
      continue;
    }
    const auto member = static_cast<std::size_t>(assignment.members[slot]);
    names.push_back(crew[slot].worker ? names_of.workers[member] : names_of.carriers[member]);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string alternatives_text(const LineModel& line, const DecisionExplanation& explanation) {
  std::string text;
  for (const auto& alternative : explanation.alternatives) {
    const bool chosen = explanation.assignment && explanation.assignment->task == alternative.task;
    text +=
        fmt::format("    {} {}: ", chosen ? "*" : " ", line.tasks[alternative.task.index()].name);
    if (alternative.ruled_out) {
      text += "ruled out: the order could not be finished after it\n";
    } else if (alternative.estimate) {
      text += fmt::format("the run would end at about {}\n", *alternative.estimate);
    } else {
      text += "the simple rule that estimates does not finish after it\n";
    }
  }
  return text;
}

std::string member_text(const LineModel& line, const Names& names,
                        const DecisionExplanation::Member& member) {
  std::vector<std::string> ways;
  std::string chosen = "nobody yet";
  for (const auto& candidate : member.candidates) {
    const std::string& name = names.workers[candidate.worker.index()];
    if (candidate.chosen) chosen = name;
    if (!member.needed_at) continue;
    ways.push_back(candidate.way.ticks < 0
                       ? name + " has no way"
                       : fmt::format("{} {} ticks, {:.1f} m", name, candidate.way.ticks,
                                     candidate.way.metres));
  }
  std::string text = fmt::format("    {}: {}", member.role, chosen);
  if (member.candidates.size() == 1) text += ", the only free one";
  if (member.needed_at) {
    text += fmt::format("; to {}: {}", line.stations[member.needed_at->index()].name,
                        fmt::join(ways, "; "));
  }
  return text + "\n";
}

}  // namespace

std::string explanation_text(const LineModel& line, const RunSetup& setup,
                             const DecisionExplanation& explanation) {
  const Names names{worker_names(line, setup), carrier_names(line, setup)};
  std::string text = fmt::format("tick {}: ", explanation.tick);
  text += explanation.assignment
              ? fmt::format("{} by {}\n", line.tasks[explanation.assignment->task.index()].name,
                            crew_text(line, names, *explanation.assignment))
              : "waits\n";
  text += fmt::format("  could be chosen (* was){}:\n",
                      explanation.planned_end ? ", with a simple rule going on from there" : "");
  text += alternatives_text(line, explanation);
  if (explanation.planned_end)
    text += fmt::format("  as planned the run ends at {}\n", *explanation.planned_end);
  if (!explanation.members.empty()) text += "  who:\n";
  for (const auto& member : explanation.members) text += member_text(line, names, member);
  if (!explanation.unselectable.empty()) text += "  could not be chosen:\n";
  for (const auto& task : explanation.unselectable)
    text += fmt::format("      {}: {}\n", line.tasks[task.task.index()].name, task.reason);
  return text;
}

}  // namespace linewright
