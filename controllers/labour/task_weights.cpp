#include "controllers/labour/task_weights.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "controllers/labour/agent_called.h"
#include "hal/types/math.h"

namespace controllers {
namespace {

using Mistakes = std::vector<hal::ParameterMistake>;

std::vector<std::string> accepted(std::vector<std::string> tasks,
                                  const hal::Parameters& parameters) {
  refuse(TaskWeights::mistakes(tasks, parameters));
  return tasks;
}

}  // namespace

std::vector<hal::ParameterSpec> TaskWeights::parameters() {
  return {
      {"weights.initial", "1", 0.5, 1e-6, 1e6, "Of every task at the start."},
      {"weights.least", "1", 0.1, 1e-6, 1e6, "No weight falls below it."},
      {"weights.most", "1", 1, 1e-6, 1e6, "No weight rises above it."},
      {"weights.step", "1", 0.05, 0, 1e6, "By which a success raises and a failure lowers it."},
      {"weights.exponent", "1", 2, 1, 20, "Of the weights in the probabilities."},
      {.name = "weights.rule",
       .default_value = "fixed",
       .meaning = "Whether each success or failure moves a weight by a step, or the k-th one in "
                  "a row by k steps.",
       .choices = {"fixed", "variable"}}};
}

Mistakes TaskWeights::mistakes(const std::vector<std::string>& tasks,
                               const hal::Parameters& parameters) {
  Mistakes all;
  if (tasks.empty()) all.push_back({"tasks", "is empty; an agent needs one at least"});
  std::set<std::string> seen;
  for (const std::string& task : tasks) {
    if (!seen.insert(task).second) all.push_back({"tasks", "'" + task + "' twice"});
  }
  const double initial = parameters["weights.initial"];
  const double least = parameters["weights.least"], most = parameters["weights.most"];
  if (initial < least || initial > most) {
    all.push_back({"weights.initial", std::to_string(initial) + " is not between weights.least, " +
                                          std::to_string(least) + ", and weights.most, " +
                                          std::to_string(most)});
  }
  return all;
}

TaskWeights::TaskWeights(std::vector<std::string> tasks, const hal::Parameters& parameters)
    : tasks_(accepted(std::move(tasks), parameters)),
      least_(parameters["weights.least"]),
      most_(parameters["weights.most"]),
      step_(parameters["weights.step"]),
      exponent_(parameters["weights.exponent"]),
      counts_in_a_row_(parameters.text("weights.rule") == "variable"),
      weights_(tasks_.size(), parameters["weights.initial"]),
      in_a_row_(tasks_.size()),
      successes_(tasks_.size()),
      failures_(tasks_.size()) {}

std::optional<std::size_t> TaskWeights::find(const std::string& task) const {
  const auto found = std::ranges::find(tasks_, task);
  if (found == tasks_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - tasks_.begin());
}

/// tau^exponent of (T1), relative to the greatest permitted weight so that no power overflows.
double TaskWeights::power(std::size_t task) const {
  return hal::math::pow(weights_[task] / most_, exponent_);
}

std::vector<double> TaskWeights::probabilities() const {
  std::vector<double> result;
  result.reserve(tasks_.size());
  for (std::size_t i = 0; i < tasks_.size(); ++i) result.push_back(power(i));
  const double sum = std::accumulate(result.begin(), result.end(), 0.0);
  for (double& one : result) one /= sum;
  return result;
}

std::optional<std::size_t> TaskWeights::draw(const std::vector<bool>& can_do,
                                             hal::RandomStream& random) const {
  double sum = 0;
  for (std::size_t i = 0; i < tasks_.size(); ++i) sum += can_do[i] ? power(i) : 0;
  if (sum == 0) return std::nullopt;
  double left = random.uniform() * sum;
  std::optional<std::size_t> drawn;
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    if (!can_do[i]) continue;
    drawn = i;  // also covers a remainder left by rounding
    left -= power(i);
    if (left < 0) break;
  }
  return drawn;
}

bool TaskWeights::learn(std::size_t task, bool succeeded) {
  int& in_a_row = in_a_row_[task];
  const int way = succeeded ? 1 : -1;
  in_a_row = in_a_row * way > 0 ? in_a_row + way : way;
  ++(succeeded ? successes_ : failures_)[task];
  const double before = weights_[task];
  // (T3) or (T2)
  const double moved = before + step_ * (counts_in_a_row_ ? in_a_row : way);
  weights_[task] = std::clamp(moved, least_, most_);
  return weights_[task] != before;
}

void TaskWeights::record(hal::RealWorldObject& self) const {
  const std::vector<double> all = probabilities();
  for (std::size_t i = 0; i < tasks_.size(); ++i) self.record("p_" + tasks_[i], all[i]);
}

void TaskWeights::record_outcomes(hal::RealWorldObject& self) const {
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    self.record("succeeded_" + tasks_[i], successes_[i]);
    self.record("failed_" + tasks_[i], failures_[i]);
  }
}

void TaskWeights::record_outcome(hal::RealWorldObject& self, std::size_t task,
                                 bool succeeded) const {
  self.record((succeeded ? "succeeded_" : "failed_") + tasks_[task],
              (succeeded ? successes_ : failures_)[task]);
}

}  // namespace controllers
