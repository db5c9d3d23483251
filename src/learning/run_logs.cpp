#include "run_logs.hpp"

#include <utility>

namespace linewright::learning {
namespace {

const std::vector<std::string>& progress_columns() {
  static const std::vector<std::string> kColumns{
      "updates",       "decisions", "episodes", "stored",        "reward",
      "length",        "makespan",  "progress", "success",       "epsilon",
      "learning_rate", "loss",      "mean_q",   "gradient_norm", "wall_time_s"};
  return kColumns;
}

std::vector<std::string> evaluation_columns(const std::vector<std::string>& crews) {
  std::vector<std::string> columns{"updates", "makespan", "success", "progress"};
  columns.insert(columns.end(), crews.begin(), crews.end());
  return columns;
}

std::string file(const std::string& folder, const char* name) { return folder + "/" + name; }

CsvLog csv(const std::string& path, const std::vector<std::string>& columns,
           const std::vector<std::uint64_t>& sizes, std::size_t index) {
  return sizes.empty() ? CsvLog::create(path, columns)
                       : CsvLog::reopen(path, columns, sizes[index]);
}

}  // namespace

RunLogs::RunLogs(const std::string& folder, const std::vector<std::string>& crews,
                 const std::vector<std::uint64_t>& sizes, double wall_time_s)
    : crews_(crews),
      progress_(csv(file(folder, "progress.csv"), progress_columns(), sizes, 0)),
      evaluations_(csv(file(folder, "evaluations.csv"), evaluation_columns(crews), sizes, 1)),
      board_(sizes.empty() ? TensorBoardLog::create(
                                 file(folder, "events.out.tfevents.0.linewright"), wall_time_s)
                           : TensorBoardLog::reopen(
                                 file(folder, "events.out.tfevents.0.linewright"), sizes[2])) {}

void RunLogs::progress(const TrainingStatus& status, double wall_time_s) {
  progress_.row(std::vector<double>{
      static_cast<double>(status.updates), static_cast<double>(status.decisions),
      static_cast<double>(status.episodes), static_cast<double>(status.stored), status.reward,
      status.length, status.makespan, status.progress, status.success, status.epsilon,
      status.learning_rate, status.loss, status.mean_q, status.gradient_norm, wall_time_s});
  const std::pair<const char*, double> scalars[] = {
      {"rollout/ep_rew_mean", status.reward},
      {"rollout/ep_len_mean", status.length},
      {"rollout/exploration_rate", status.epsilon},
      {"time/total_timesteps", static_cast<double>(status.decisions)},
      {"train/n_updates", static_cast<double>(status.updates)},
      {"train/learning_rate", status.learning_rate},
      {"train/loss", status.loss},
      {"linewright/mean_q", status.mean_q},
      {"linewright/gradient_norm", status.gradient_norm},
      {"linewright/makespan", status.makespan},
      {"linewright/progress", status.progress},
      {"linewright/success", status.success}};
  for (const auto& [tag, value] : scalars) {
    board_.scalar(tag, status.decisions, static_cast<float>(value), wall_time_s);
  }
}

void RunLogs::evaluation(const EvaluationReport& report, double wall_time_s) {
  std::vector<double> row{static_cast<double>(report.update), report.makespan, report.success,
                          report.progress};
  row.insert(row.end(), report.crew_makespan.begin(), report.crew_makespan.end());
  evaluations_.row(row);
  board_.scalar("eval/makespan", report.update, static_cast<float>(report.makespan), wall_time_s);
  board_.scalar("eval/success", report.update, static_cast<float>(report.success), wall_time_s);
  board_.scalar("eval/progress", report.update, static_cast<float>(report.progress), wall_time_s);
  for (std::size_t c = 0; c < crews_.size(); ++c) {
    board_.scalar("eval_makespan/" + crews_[c], report.update,
                  static_cast<float>(report.crew_makespan[c]), wall_time_s);
  }
}

void RunLogs::flush() {
  progress_.flush();
  evaluations_.flush();
  board_.flush();
}

std::vector<std::uint64_t> RunLogs::sizes() const {
  return {progress_.size(), evaluations_.size(), board_.size()};
}

}  // namespace linewright::learning
