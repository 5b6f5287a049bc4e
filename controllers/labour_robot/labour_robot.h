#pragma once

#include <optional>
#include <string>
#include <vector>

#include "controllers/help/help_trip.h"
#include "controllers/help/travel.h"
#include "controllers/labour/task_weights.h"
#include "controllers/labour_robot/patrol.h"
#include "controllers/labour_robot/requesters.h"
#include "hal/api/controller.h"

namespace controllers {

/// A robot that repeatedly chooses a random task, and prefers those in which it succeeded
/// (TaskWeights):
///
///   task     what it does                                      succeeds if
///   answer   goes to a mote that called for help (HelpTrip),   it arrived; refused, because
///   another
///            drawn from those that called (Requesters)         robot has the task, or given up, a
///                                                              failure
///   patrol   goes to a post and stays as a gateway (Patrol)    it was reached in time, and the
///                                                              sink's receipt came
///   idle     waits where it is                                 no mote called for help meanwhile
///
/// answer can be chosen only while a call is fresh, patrol only while a post is localised. When the
/// robot hears a call during patrol or idle, it draws again: if it draws answer, it aborts the
/// current task, which then counts neither as a success nor as a failure; otherwise it continues.
/// Robots that are not needed for a call are refused, and so learn to leave calls to others.
///
/// It records "p_<task>" at the start and whenever one of them changes; the totals
/// "succeeded_<task>" and "failed_<task>" whenever one of them increases, and all of them at the
/// end. States: those of HelpTrip, PATROL, GATEWAY.
class LabourRobot : public hal::Controller {
 public:
  LabourRobot(hal::Robot& robot, const hal::Parameters& parameters);
  static std::vector<hal::ParameterSpec> parameters();
  static std::vector<hal::ParameterMistake> mistakes(const hal::Parameters& parameters);
  static std::vector<std::string> states();

  void start() override;
  void step() override;
  void receive(const hal::Message& message) override;
  void timer(hal::TimerId id) override;
  void stop() override;

 private:
  enum class Task { kAnswer, kPatrol, kIdle };

  bool can_do(Task task) const;
  std::optional<std::size_t> draw();
  void begin(std::size_t task);
  void reconsider();
  bool is_over() const;
  bool succeeded() const;
  void settle();
  void learn(std::size_t task, bool succeeded);

  hal::Robot& robot_;
  const std::string sink_name_;
  const std::vector<hal::ParameterMistake> mistakes_;  ///< Reported by start().
  const hal::Duration fresh_for_;
  const double requester_beta_;
  const bool refusal_fails_;
  const double idle_;  ///< s, mean.
  TaskWeights weights_;
  std::vector<Task> kinds_;  ///< By index of the task.
  Travel travel_;
  HelpTrip trip_;
  Patrol patrol_;
  Requesters requesters_;

  std::optional<std::size_t> current_;
  hal::Time idle_until_{};
  bool heard_call_ = false;  ///< Since the task began.
  bool is_called_ = false;   ///< Since the last control cycle.
};

}  // namespace controllers
