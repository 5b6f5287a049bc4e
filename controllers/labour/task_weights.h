#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hal/api/controller.h"

namespace controllers {

/// How much an agent inclines to each of its tasks. The task of weight tau_i is drawn with
///
///   P(i) = tau_i^exponent / sum over k of tau_k^exponent
///
/// and what comes of it moves its weight within [least, most]:
///
///   rule fixed      tau_i + step after a success, tau_i - step after a failure
///   rule variable   tau_i + k step after the k-th success in a row, - k step after the k-th
///   failure
///
/// Sources: for P and the fixed rule, Labella, Dressler, "A Bio-Inspired Architecture for Division
/// of Labour in SANETs", 2006, as Dressler, Akan, "A survey on bio-inspired networking", 2010,
/// tells it; for the other, the variable delta rule of Labella, Dorigo, Deneubourg, "Division of
/// labor in a group of robots inspired by ants' foraging behavior", 2006.
class TaskWeights {
 public:
  /// weights.initial, .least, .most, .step, .exponent, .rule.
  static std::vector<hal::ParameterSpec> parameters();

  /// What cannot be: no task, one that is named twice, `initial` not between `least` and `most`.
  static std::vector<hal::ParameterMistake> mistakes(const std::vector<std::string>& tasks,
                                                     const hal::Parameters& parameters);

  /// @param tasks  their names, each once.
  /// @throws std::invalid_argument  the first of the mistakes(), if there are any.
  TaskWeights(std::vector<std::string> tasks, const hal::Parameters& parameters);

  /// Number of a task among those given; none: the agent does not have it.
  std::optional<std::size_t> find(const std::string& task) const;
  const std::vector<std::string>& tasks() const { return tasks_; }
  double weight(std::size_t task) const { return weights_[task]; }

  /// P of every task; their sum is 1 but for rounding.
  std::vector<double> probabilities() const;
  /// One task, by P among those for which there is something to do.
  /// @param can_do  by task. @return none, and nothing was drawn, if there is none.
  std::optional<std::size_t> draw(const std::vector<bool>& can_do, hal::RandomStream& random) const;
  /// Notes what came of a task. @return whether its weight moved.
  bool learn(std::size_t task, bool succeeded);

  /// Records P of every task as "p_<task>".
  void record(hal::RealWorldObject& self) const;
  /// Records how often each task was a success and a failure: "succeeded_<task>", "failed_<task>".
  void record_outcomes(hal::RealWorldObject& self) const;
  /// Records that of a task that just came to be one or the other: the rows of a run are then the
  /// history of its tasks, those that moved no weight included.
  void record_outcome(hal::RealWorldObject& self, std::size_t task, bool succeeded) const;

 private:
  double power(std::size_t task) const;

  std::vector<std::string> tasks_;
  double least_, most_, step_, exponent_;
  bool counts_in_a_row_;
  std::vector<double> weights_;
  std::vector<int> in_a_row_;  ///< Successes, or with a minus failures, since there was the other.
  std::vector<int> successes_, failures_;
};

}  // namespace controllers
