#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hal/api/controller.h"

namespace controllers {

/// An agent's preferences for its tasks. A task with weight tau_i is drawn with the probability
///
///   (T1) P(i) = tau_i^exponent / sum over k of tau_k^exponent
///
/// and its outcome changes its weight within [least, most]:
///
///   (T2) rule fixed      tau_i := tau_i + step after a success, tau_i - step after a failure
///   (T3) rule variable   tau_i := tau_i + k step after the k-th success in a row,
///                        tau_i - k step after the k-th failure in a row
///
/// Sources (the numbers are not those of the papers): for (T1) and (T2), Labella, Dressler, "A
/// Bio-Inspired Architecture for Division of Labour in SANETs", 2006, as described by Dressler,
/// Akan, "A survey on bio-inspired networking", 2010; for (T3), the variable delta rule of Labella,
/// Dorigo, Deneubourg, "Division of labor in a group of robots inspired by ants' foraging
/// behavior", 2006.
class TaskWeights {
 public:
  /// Parameters weights.initial, .least, .most, .step, .exponent, .rule.
  static std::vector<hal::ParameterSpec> parameters();

  /// Contradictions: no task, a task listed twice, `initial` not between `least` and `most`.
  static std::vector<hal::ParameterMistake> mistakes(const std::vector<std::string>& tasks,
                                                     const hal::Parameters& parameters);

  /// @param tasks  names, each once.
  /// @throws std::invalid_argument  the first of the mistakes(), if there are any.
  TaskWeights(std::vector<std::string> tasks, const hal::Parameters& parameters);

  /// Index of a task among those given; nullopt: the agent does not have it.
  std::optional<std::size_t> find(const std::string& task) const;
  const std::vector<std::string>& tasks() const { return tasks_; }
  double weight(std::size_t task) const { return weights_[task]; }

  /// P of (T1) for every task; the sum is 1 except for rounding.
  std::vector<double> probabilities() const;
  /// Draws a task with the probabilities (T1), restricted to the tasks that can be done.
  /// @param can_do  by task. @return nullopt, without drawing, if no task can be done.
  std::optional<std::size_t> draw(const std::vector<bool>& can_do, hal::RandomStream& random) const;
  /// Applies (T2) or (T3) after a task. @return whether its weight changed.
  bool learn(std::size_t task, bool succeeded);

  /// Records P of every task as "p_<task>".
  void record(hal::RealWorldObject& self) const;
  /// Records the number of successes and failures of each task: "succeeded_<task>",
  /// "failed_<task>".
  void record_outcomes(hal::RealWorldObject& self) const;
  /// Records that number for the task that just ended: the rows of a run then form the history of
  /// its tasks, including those that did not change a weight.
  void record_outcome(hal::RealWorldObject& self, std::size_t task, bool succeeded) const;

 private:
  double power(std::size_t task) const;

  std::vector<std::string> tasks_;
  double least_, most_, step_, exponent_;
  bool counts_in_a_row_;
  std::vector<double> weights_;
  /// Consecutive successes, or consecutive failures as a negative number.
  std::vector<int> in_a_row_;
  std::vector<int> successes_, failures_;
};

}  // namespace controllers
