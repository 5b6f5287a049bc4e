#include "controllers/labour/task_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

namespace {

using controllers::TaskWeights;
using Tasks = std::vector<std::string>;

const Tasks kFour = {"temperature", "audio", "video", "help"};

hal::Parameters parameters(const hal::Parameters::Values& given = {}) {
  hal::Parameters::Values values = given;
  for (const hal::ParameterSpec& one : TaskWeights::parameters()) {
    values.emplace(one.name, one.default_value);
  }
  return hal::Parameters(values);
}

TEST(TaskWeights, StartWithEqualProbabilities) {
  const TaskWeights weights(kFour, parameters());
  EXPECT_EQ(weights.probabilities(), (std::vector<double>{0.25, 0.25, 0.25, 0.25}));
}

// 0.5 + 3 * 0.05 = 0.65: 0.4225 / (0.4225 + 3 * 0.25).
TEST(TaskWeights, MoveByAStepWithEverySuccessAndFailure) {
  TaskWeights weights(kFour, parameters());
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(weights.learn(0, true));
  EXPECT_NEAR(weights.probabilities()[0], 0.4225 / 1.1725, 1e-15);
  EXPECT_TRUE(weights.learn(0, false));
  EXPECT_NEAR(weights.weight(0), 0.6, 1e-15);
}

TEST(TaskWeights, TakeTheExponent) {
  TaskWeights weights({"a", "b"}, parameters({{"weights.exponent", 3}, {"weights.step", 0.25}}));
  weights.learn(0, true);
  EXPECT_NEAR(weights.probabilities()[0], 0.421875 / (0.421875 + 0.125), 1e-15);
}

TEST(TaskWeights, StopAtTheirBounds) {
  TaskWeights weights({"a", "b"}, parameters());
  for (int i = 0; i < 100; ++i) weights.learn(0, true);
  for (int i = 0; i < 100; ++i) weights.learn(1, false);
  EXPECT_EQ(weights.weight(0), 1);
  EXPECT_EQ(weights.weight(1), 0.1);
  EXPECT_FALSE(weights.learn(0, true)) << "it did not move";
  EXPECT_NEAR(weights.probabilities()[0], 1 / 1.01, 1e-15);
}

// Steps of 1, 2, 3 times 0.05, and from the first failure of 1, 2 times again.
TEST(TaskWeights, MoveFasterTheMoreComeInARowByTheVariableRule) {
  TaskWeights weights({"a", "b"}, parameters({{"weights.rule", "variable"}}));
  for (int i = 0; i < 3; ++i) weights.learn(0, true);
  EXPECT_NEAR(weights.weight(0), 0.5 + 6 * 0.05, 1e-15);
  weights.learn(1, false);
  EXPECT_NEAR(weights.weight(1), 0.45, 1e-15) << "rows are those of one task";
  for (int i = 0; i < 2; ++i) weights.learn(0, false);
  EXPECT_NEAR(weights.weight(0), 0.8 - 3 * 0.05, 1e-15);
}

TEST(TaskWeights, SumToOneAndStayInBoundsWhateverComes) {
  hal::RandomStream random(7, "outcomes");
  for (const char* rule : {"fixed", "variable"}) {
    TaskWeights weights(kFour, parameters({{"weights.rule", rule}, {"weights.step", 0.037}}));
    const double least = 0.01 / 3.01, most = 1 / 1.03;
    for (int i = 0; i < 10000; ++i) {
      weights.learn(random.below(4), random.uniform() < 0.6);
      const auto all = weights.probabilities();
      ASSERT_NEAR(std::accumulate(all.begin(), all.end(), 0.0), 1, 1e-12);
      for (const double one : all) {
        ASSERT_GE(one, least - 1e-12);
        ASSERT_LE(one, most + 1e-12);
      }
    }
  }
}

// 4 sigma of a share p of n draws is 4 sqrt(p (1 - p) / n).
TEST(TaskWeights, DrawByProbabilityAmongWhatCanBeDone) {
  TaskWeights weights(kFour, parameters());
  for (int i = 0; i < 5; ++i) weights.learn(1, true);
  hal::RandomStream random(3, "draws");
  constexpr int kDraws = 40000;
  std::vector<int> count(4);
  for (int i = 0; i < kDraws; ++i) ++count[*weights.draw({true, true, true, false}, random)];
  const double p = 0.5625 / (0.5625 + 0.5);
  EXPECT_NEAR(count[1] / double(kDraws), p, 4 * std::sqrt(p * (1 - p) / kDraws));
  EXPECT_NEAR(count[0], count[2], 800);
  EXPECT_EQ(count[3], 0);
  EXPECT_EQ(weights.draw({false, false, false, true}, random), 3u);
  EXPECT_EQ(weights.draw({false, false, false, false}, random), std::nullopt);
}

std::string refusal(const Tasks& tasks, const hal::Parameters::Values& given = {}) {
  try {
    const TaskWeights weights(tasks, parameters(given));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(TaskWeights, RefuseWhatMakesNoSense) {
  EXPECT_EQ(refusal({}), "tasks: is empty; an agent needs one at least");
  EXPECT_EQ(refusal({"a", "b", "a"}), "tasks: 'a' twice");
  EXPECT_EQ(refusal({"a"}, {{"weights.initial", 2}}),
            "weights.initial: 2.000000 is not between weights.least, 0.100000, and weights.most, "
            "1.000000");
}

}  // namespace
