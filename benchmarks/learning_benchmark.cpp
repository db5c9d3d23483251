// One update of the Q-learner (double-Q targets, forward, backward, Adam) by size, batch and number
// of threads, on observations of the duct line.
// usage: learning_benchmark [UPDATES]                                               (default: 30)

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <vector>

#include "../src/learning/duct_line.hpp"
#include "linewright/learning/q_learner.hpp"
#include "linewright/learning/runtime.hpp"

namespace {

using namespace linewright;
using Clock = std::chrono::steady_clock;

ReplayBatch batch_of(const learning::SeenStates& seen, std::size_t rows) {
  const auto part = [&](const auto& column, std::size_t first) {
    const std::size_t width = column.size() / seen.count;
    return std::vector(column.begin() + static_cast<std::ptrdiff_t>(first * width),
                       column.begin() + static_cast<std::ptrdiff_t>((first + rows) * width));
  };
  ReplayBatch batch;
  batch.size = rows;
  batch.features = part(seen.features, 0);
  batch.present = part(seen.present, 0);
  batch.next_features = part(seen.features, 1);
  batch.next_present = part(seen.present, 1);
  batch.next_selectable = part(seen.selectable, 1);
  for (std::size_t i = 0; i < rows; ++i) {
    const std::size_t actions = seen.spec.actions.size();
    const std::uint8_t* selectable = seen.selectable.data() + i * actions;
    batch.action.push_back(std::find(selectable, selectable + actions, 1) - selectable);
  }
  batch.returns.assign(rows, 0.1F);
  batch.discount.assign(rows, 0.99F);
  batch.weight.assign(rows, 1.0F);
  return batch;
}

double median_ms(const learning::SeenStates& seen, const NetworkOptions& options, std::size_t rows,
                 std::size_t threads, int updates) {
  QLearner learner(seen.spec, options, initial_tensors(seen.spec, options, 1), {.threads = threads},
                   1);
  const ReplayBatch batch = batch_of(seen, rows);
  std::vector<float> errors;
  std::vector<double> times;
  for (int i = 0; i < updates + 3; ++i) {
    const auto start = Clock::now();
    learner.update(batch, 1e-4, errors);
    const std::chrono::duration<double, std::milli> took = Clock::now() - start;
    if (i >= 3) times.push_back(took.count());
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_TOP_PAD, 64 << 20);
  const int updates = argc > 1 ? std::max(1, std::atoi(argv[1])) : 30;
  const auto seen =
      learning::random_states(LINEWRIGHT_SOURCE_DIR "/scenarios/duct_line.yaml", 600, 1);
  fmt::print("{} tokens, {} features; median of {} updates\n", seen.spec.token_count(),
             seen.spec.feature_count(), updates);
  fmt::print("{:>6} {:>6} {:>6} {:>8} {:>10} {:>12}  {}\n", "width", "layers", "batch", "threads",
             "ms", "us/sample", "matrices by");
  for (const std::size_t threads : {1, 2}) {
    const LearningRuntime runtime = prepare_learning(threads);
    for (const int width : {32, 64, 128}) {
      for (const int layers : {1, 2}) {
        for (const std::size_t rows : {64, 128, 512}) {
          const NetworkOptions options{
              .width = width, .encoder_layers = layers, .feedforward = 2 * width};
          const double ms = median_ms(seen, options, rows, threads, updates);
          fmt::print("{:>6} {:>6} {:>6} {:>8} {:>10.2f} {:>12.0f}  {}\n", width, layers, rows,
                     threads, ms, 1000.0 * ms / static_cast<double>(rows), runtime.blas);
          std::fflush(stdout);
        }
      }
    }
  }
}
