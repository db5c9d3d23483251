#include "checkpoint.hpp"

#include <fmt/format.h>

#include "byte_stream.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/hash.hpp"

namespace linewright::learning {
namespace {

constexpr std::string_view kMagic = "LWCHECKPOINT2\n\n\n";  // 16 bytes; the digit is the version

void put(ByteWriter& out, const EvaluationReport& report) {
  out.put(report.update);
  out.put(report.makespan);
  out.put(report.success);
  out.put(report.progress);
  out.put(report.all_succeeded);
  out.put_all(report.crew_makespan);
}

EvaluationReport get_report(ByteReader& in) {
  EvaluationReport report;
  report.update = in.get<std::int64_t>();
  report.makespan = in.get<double>();
  report.success = in.get<double>();
  report.progress = in.get<double>();
  report.all_succeeded = in.get<bool>();
  report.crew_makespan = in.get_all<double>();
  return report;
}

void put(ByteWriter& out, const RandomStream::State& state) {
  for (const std::uint64_t word : state) out.put(word);
}

RandomStream::State get_random(ByteReader& in) {
  RandomStream::State state;
  for (std::uint64_t& word : state) word = in.get<std::uint64_t>();
  return state;
}

void put(ByteWriter& out, const LearnerState& learner) {
  out.put_all(learner.parameters);
  out.put_all(learner.target);
  out.put_all(learner.adam_mean);
  out.put_all(learner.adam_square);
  out.put_all(learner.average);
  out.put(learner.steps);
  put(out, learner.noise);
}

LearnerState get_learner(ByteReader& in) {
  LearnerState learner;
  learner.parameters = in.get_all<float>();
  learner.target = in.get_all<float>();
  learner.adam_mean = in.get_all<float>();
  learner.adam_square = in.get_all<float>();
  learner.average = in.get_all<float>();
  learner.steps = in.get<std::int64_t>();
  learner.noise = get_random(in);
  return learner;
}

void put(ByteWriter& out, const ReplayState& replay) {
  out.put(replay.first);
  out.put(replay.next);
  out.put(replay.largest);
  out.put_all(replay.leaves);
  out.put(static_cast<std::uint64_t>(replay.episodes.size()));
  for (const ReplayEpisode& episode : replay.episodes) {
    out.put(episode.tag);
    out.put(episode.copies);
    out.put(episode.evicted);
  }
}

ReplayState get_replay(ByteReader& in) {
  ReplayState replay;
  replay.first = in.get<std::uint64_t>();
  replay.next = in.get<std::uint64_t>();
  replay.largest = in.get<double>();
  replay.leaves = in.get_all<float>();
  const std::uint64_t episodes = in.get_count(20);
  for (std::uint64_t i = 0; i < episodes; ++i) {
    ReplayEpisode episode;
    episode.tag = in.get<std::uint64_t>();
    episode.copies = in.get<std::uint32_t>();
    episode.evicted = in.get<std::uint64_t>();
    replay.episodes.push_back(episode);
  }
  return replay;
}

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
  throw ScenarioError(file, what, "start again without --resume, or name another folder");
}

}  // namespace

std::string to_bytes(const Checkpoint& checkpoint) {
  ByteWriter out;
  out.put_text(checkpoint.options);
  out.put_text(checkpoint.scenario);
  out.put(checkpoint.seed);
  for (const std::int64_t count : {checkpoint.updates, checkpoint.decisions, checkpoint.episodes,
                                   checkpoint.stored, checkpoint.credit}) {
    out.put(count);
  }
  out.put(static_cast<std::uint64_t>(checkpoint.recent.size()));
  for (const EpisodeFigures& figures : checkpoint.recent) {
    for (const double value :
         {figures.reward, figures.length, figures.makespan, figures.progress, figures.success}) {
      out.put(value);
    }
  }
  out.put_all(checkpoint.interval);
  put(out, checkpoint.best);
  put(out, checkpoint.latest);
  put(out, checkpoint.learner);
  put(out, checkpoint.sampling);
  out.put(static_cast<std::uint64_t>(checkpoint.runs.size()));
  for (const Collector::RunState& run : checkpoint.runs) {
    out.put(run.episode);
    out.put_all(run.actions);
    put(out, run.random);
    out.put(run.total_reward);
    out.put_all(run.log_probability);
    out.put_all(run.value);
  }
  put(out, checkpoint.replay);
  out.put(static_cast<std::uint64_t>(checkpoint.records.size()));
  for (const EpisodeRecord& record : checkpoint.records) {
    out.put(record.number);
    out.put_all(record.actions);
  }
  out.put_all(checkpoint.log_sizes);
  std::string bytes = std::string(kMagic) + out.bytes();
  const std::uint64_t hash = hash_of(bytes);
  bytes.append(reinterpret_cast<const char*>(&hash), sizeof hash);
  return bytes;
}

Checkpoint checkpoint_from_bytes(std::string_view bytes, const std::string& file) {
  constexpr std::size_t kName = 12;
  if (bytes.size() < kMagic.size() || bytes.substr(0, kName) != kMagic.substr(0, kName)) {
    refuse(file, "is not a checkpoint of linewright");
  }
  if (bytes.substr(0, kMagic.size()) != kMagic) {
    refuse(file, "is a checkpoint of another version of linewright");
  }
  std::uint64_t hash = 0;
  if (bytes.size() < kMagic.size() + sizeof hash) refuse(file, "is cut off");
  std::memcpy(&hash, bytes.data() + bytes.size() - sizeof hash, sizeof hash);
  const std::string_view content = bytes.substr(0, bytes.size() - sizeof hash);
  if (hash != hash_of(content)) {
    refuse(file, fmt::format("is cut off or damaged ({} bytes)", bytes.size()));
  }
  ByteReader in(content.substr(kMagic.size()));
  Checkpoint checkpoint;
  checkpoint.options = in.get_text();
  checkpoint.scenario = in.get_text();
  checkpoint.seed = in.get<std::uint64_t>();
  for (std::int64_t* count : {&checkpoint.updates, &checkpoint.decisions, &checkpoint.episodes,
                              &checkpoint.stored, &checkpoint.credit}) {
    *count = in.get<std::int64_t>();
  }
  for (std::uint64_t i = in.get_count(5 * sizeof(double)); i > 0; --i) {
    EpisodeFigures figures;
    for (double* value : {&figures.reward, &figures.length, &figures.makespan, &figures.progress,
                          &figures.success}) {
      *value = in.get<double>();
    }
    checkpoint.recent.push_back(figures);
  }
  checkpoint.interval = in.get_all<double>();
  checkpoint.best = get_report(in);
  checkpoint.latest = get_report(in);
  checkpoint.learner = get_learner(in);
  checkpoint.sampling = get_random(in);
  for (std::uint64_t i = in.get_count(64); i > 0; --i) {
    Collector::RunState run;
    run.episode = in.get<std::uint64_t>();
    run.actions = in.get_all<std::uint16_t>();
    run.random = get_random(in);
    run.total_reward = in.get<double>();
    run.log_probability = in.get_all<float>();
    run.value = in.get_all<float>();
    checkpoint.runs.push_back(std::move(run));
  }
  checkpoint.replay = get_replay(in);
  for (std::uint64_t i = in.get_count(16); i > 0; --i) {
    EpisodeRecord record;
    record.number = in.get<std::uint64_t>();
    record.actions = in.get_all<std::uint16_t>();
    checkpoint.records.push_back(std::move(record));
  }
  checkpoint.log_sizes = in.get_all<std::uint64_t>();
  if (!in.complete()) refuse(file, "is damaged: its parts do not fit together");
  return checkpoint;
}

}  // namespace linewright::learning
