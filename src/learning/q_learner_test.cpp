#include "linewright/learning/q_learner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "duct_line.hpp"

namespace linewright::learning {
namespace {

const SeenStates& states() {
  static const SeenStates kStates =
      random_states(LINEWRIGHT_SOURCE_DIR "/scenarios/duct_line.yaml", 64, 4);
  return kStates;
}

NetworkOptions quiet_network() {
  return {.width = 16, .heads = 2, .feedforward = 16, .head_hidden = 16, .noisy = false};
}

/// Rows 0 ... 15 lead to rows 16 ... 31; the last four are terminal.
ReplayBatch batch_of(std::size_t rows) {
  const SeenStates& seen = states();
  const auto part = [&](const auto& column, std::size_t first) {
    const std::size_t width = column.size() / seen.count;
    return std::vector(column.begin() + static_cast<std::ptrdiff_t>(first * width),
                       column.begin() + static_cast<std::ptrdiff_t>((first + rows) * width));
  };
  ReplayBatch batch;
  batch.size = rows;
  batch.features = part(seen.features, 0);
  batch.present = part(seen.present, 0);
  batch.next_features = part(seen.features, rows);
  batch.next_present = part(seen.present, rows);
  batch.next_selectable = part(seen.selectable, rows);
  for (std::size_t i = 0; i < rows; ++i) {
    const std::uint8_t* selectable = seen.selectable.data() + i * seen.spec.actions.size();
    batch.action.push_back(std::find(selectable, selectable + 9, 1) - selectable);
    batch.returns.push_back(0.1F * static_cast<float>(i) - 0.5F);
    batch.to_end.push_back(i % 2 == 0 ? 2.0F : -2.0F);
    batch.discount.push_back(i + 4 < rows ? 0.9F : 0.0F);
    batch.weight.push_back(i % 2 == 0 ? 1.0F : 0.25F);
  }
  return batch;
}

std::vector<float> q_of(const Network& network, const float* features,
                        const std::uint8_t* present) {
  Workspace workspace;
  NetworkOutput output;
  network.forward(features, present, workspace, nullptr, output);
  return output.actions;
}

/// target - q of every row, by hand out of the plain networks.
std::vector<double> errors_by_hand(const ReplayBatch& batch, const Network& online,
                                   const Network& target, bool double_q) {
  const ObservationSpec& spec = states().spec;
  std::vector<double> errors;
  for (std::size_t i = 0; i < batch.size; ++i) {
    const float* next = batch.next_features.data() + i * spec.feature_count();
    const std::uint8_t* next_present = batch.next_present.data() + i * spec.token_count();
    const std::vector<float> rated = q_of(target, next, next_present);
    const std::vector<float> choice = double_q ? q_of(online, next, next_present) : rated;
    std::size_t best = 0;
    float most = -std::numeric_limits<float>::infinity();
    for (std::size_t a = 0; a < choice.size(); ++a) {
      if (batch.next_selectable[i * choice.size() + a] == 0 || choice[a] <= most) continue;
      most = choice[a];
      best = a;
    }
    const std::vector<float> q = q_of(online, batch.features.data() + i * spec.feature_count(),
                                      batch.present.data() + i * spec.token_count());
    errors.push_back(double(batch.returns[i]) + double(batch.discount[i]) * double(rated[best]) -
                     double(q[static_cast<std::size_t>(batch.action[i])]));
  }
  return errors;
}

TEST(QLearner, HasDoubleQTargetsAsByHandAndOnlyTheRewardBehindTheEnd) {
  for (const bool double_q : {true, false}) {
    const TensorMap first = initial_tensors(states().spec, quiet_network(), 1);
    QLearner learner(states().spec, quiet_network(), first, {.double_q = double_q}, 1);
    const ReplayBatch batch = batch_of(16);
    std::vector<float> errors;
    learner.update(batch, 0.01, errors);  // now online and target network differ
    const Network online(states().spec, quiet_network(), learner.tensors());
    const Network target(states().spec, quiet_network(), first);
    const UpdateReport report = learner.update(batch, 0.01, errors);
    const std::vector<double> wanted = errors_by_hand(batch, online, target, double_q);
    double loss = 0.0;
    for (std::size_t i = 0; i < batch.size; ++i) {
      EXPECT_NEAR(double(errors[i]), wanted[i], 1e-5) << i;
      loss += double(batch.weight[i]) * wanted[i] * wanted[i] / 16.0;
    }
    EXPECT_NEAR(report.loss, loss, 1e-5);
  }
}

TEST(QLearner, HasTargetsThatAreAtLeastWhatWasReached) {
  const TensorMap first = initial_tensors(states().spec, quiet_network(), 1);
  const ReplayBatch batch = batch_of(16);
  std::vector<float> free;
  std::vector<float> bounded;
  QLearner(states().spec, quiet_network(), first, {}, 1).update(batch, 0.01, free);
  QLearner(states().spec, quiet_network(), first, {.return_bound = true}, 1)
      .update(batch, 0.01, bounded);
  const Network online(states().spec, quiet_network(), first);
  int raised = 0;
  for (std::size_t i = 0; i < batch.size; ++i) {
    const std::vector<float> q =
        q_of(online, batch.features.data() + i * states().spec.feature_count(),
             batch.present.data() + i * states().spec.token_count());
    const float reached = batch.to_end[i] - q[static_cast<std::size_t>(batch.action[i])];
    EXPECT_NEAR(double(bounded[i]), double(std::max(free[i], reached)), 1e-5) << i;
    raised += reached > free[i] ? 1 : 0;
  }
  EXPECT_EQ(raised, 8);  // every other row has reached more than any network says
}

TEST(QLearner, LearnsWhatABatchSays) {
  const NetworkOptions options{.width = 16, .heads = 2, .feedforward = 16, .head_hidden = 16};
  QLearner learner(states().spec, options, initial_tensors(states().spec, options, 1), {}, 1);
  ReplayBatch batch = batch_of(16);
  std::fill(batch.discount.begin(), batch.discount.end(), 0.0F);
  std::vector<float> errors;
  const double before = learner.update(batch, 0.003, errors).loss;
  double after = before;
  for (int i = 0; i < 150; ++i) after = learner.update(batch, 0.003, errors).loss;
  EXPECT_LT(after, 0.1 * before);
}

TEST(QLearner, KeepsARunningMeanOfItsWeights) {
  const TensorMap first = initial_tensors(states().spec, quiet_network(), 1);
  QLearner learner(states().spec, quiet_network(), first, {.average = 0.9}, 1);
  QLearner plain(states().spec, quiet_network(), first, {}, 1);
  const ReplayBatch batch = batch_of(16);
  std::vector<float> errors;
  std::vector<float> mean;
  for (int step = 1; step <= 100; ++step) {
    learner.update(batch, 0.01, errors);
    plain.update(batch, 0.01, errors);
    const std::vector<float> now = learner.state().parameters;
    if (step == 1) mean = now;
    const float keep = std::min(0.9F, static_cast<float>(1 + step) / static_cast<float>(10 + step));
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = keep * mean[i] + (1.0F - keep) * now[i];
  }
  const LearnerState state = learner.state();
  double apart = 0.0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    EXPECT_NEAR(double(state.average[i]), double(mean[i]), 1e-4);
    apart = std::max(apart, std::abs(double(mean[i]) - double(state.parameters[i])));
  }
  EXPECT_GT(apart, 1e-4);                         // the mean is not the weights
  EXPECT_EQ(learner.tensors(), plain.tensors());  // and does not influence them
  EXPECT_EQ(plain.averaged_tensors(), plain.tensors());
}

TEST(QLearner, GoesOnFromItsStateBitForBit) {
  const NetworkOptions options{.width = 16, .heads = 2, .feedforward = 16, .head_hidden = 16};
  const TensorMap first = initial_tensors(states().spec, options, 1);
  const ReplayBatch batch = batch_of(16);
  std::vector<float> errors;
  const QLearnerOptions averaging{.average = 0.9};
  QLearner learner(states().spec, options, first, averaging, 1);
  for (int i = 0; i < 3; ++i) learner.update(batch, 0.003, errors);
  QLearner other(states().spec, options, initial_tensors(states().spec, options, 2), averaging, 7);
  other.restore(learner.state());
  for (int i = 0; i < 3; ++i) {
    learner.update(batch, 0.003, errors);
    other.update(batch, 0.003, errors);
  }
  EXPECT_EQ(learner.tensors(), other.tensors());
  EXPECT_EQ(learner.averaged_tensors(), other.averaged_tensors());
  LearnerState cut = learner.state();
  cut.parameters.pop_back();
  EXPECT_THROW(other.restore(cut), std::invalid_argument);
}

TEST(QLearner, ChangesNothingWhenTheLossIsNoNumber) {
  QLearner learner(states().spec, quiet_network(),
                   initial_tensors(states().spec, quiet_network(), 1), {}, 1);
  ReplayBatch batch = batch_of(16);
  batch.returns[3] = std::numeric_limits<float>::quiet_NaN();
  const TensorMap before = learner.tensors();
  std::vector<float> errors;
  EXPECT_FALSE(learner.update(batch, 0.01, errors).finite());
  EXPECT_EQ(learner.tensors(), before);
}

}  // namespace
}  // namespace linewright::learning
