#pragma once

#include <optional>
#include <string>
#include <vector>

#include "controllers/help/help_call.h"
#include "controllers/help/recurrence.h"
#include "controllers/labour/delivery.h"
#include "controllers/labour/sample_sink.h"
#include "controllers/labour/task_weights.h"
#include "hal/api/controller.h"

namespace controllers {

/// A mote that repeatedly chooses a random task, and prefers those in which it succeeded
/// (TaskWeights):
///
///   task                        is done by                         succeeds if
///   temperature, audio, video   a burst of samples to the sink,    the sink's receipt for enough
///                               topic: the task's name             of them arrives in time
///   help                        a call for a robot (HelpCall)      a robot came: FULFILLED; given
///                                                                  up, a failure
///
/// help can be chosen only while it is needed; the need arises at given times and lasts until a
/// call for it has ended. The mote rests between two tasks, but only briefly while it needs help.
/// The mote that is the sink also receives the samples of all motes (SampleSink).
///
/// It records "p_<task>" at the start and whenever one of them changes; the totals
/// "succeeded_<task>" and "failed_<task>" whenever one of them increases, and all of them at the
/// end; the total "needs" whenever help becomes necessary; and, if it is the sink, "samples_<task>"
/// at the end.
class LabourMote : public hal::Controller {
 public:
  LabourMote(hal::Mote& mote, const hal::Parameters& parameters);
  static std::vector<hal::ParameterSpec> parameters();
  static std::vector<hal::ParameterMistake> mistakes(const hal::Parameters& parameters);
  static std::vector<std::string> states();

  void start() override;
  void step() override;
  void receive(const hal::Message& message) override;
  void timer(hal::TimerId id) override;
  void stop() override;

 private:
  void choose();
  void choose_in(double seconds);
  void rest();
  void settle();

  hal::Mote& mote_;
  const std::string sink_name_;
  const std::vector<hal::ParameterMistake> mistakes_;  ///< Reported by start().
  const double rest_, rest_in_need_;                   ///< s, mean.
  TaskWeights weights_;
  std::vector<Burst> bursts_;              ///< By task.
  const std::optional<std::size_t> help_;  ///< Index of the task help, if the mote has it.
  Recurrence needs_;
  HelpCall call_;
  Delivery delivery_;
  SampleSink received_;

  std::optional<hal::AgentId> sink_;
  std::optional<std::size_t> current_;  ///< Index of the task; nullopt: it rests.
  bool needs_help_ = false;
  int needs_so_far_ = 0;
};

}  // namespace controllers
