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

/// A mote that chooses one task after the other, at random, and inclines to what it succeeds in
/// (TaskWeights):
///
///   task                        is done by                         is a success if
///   temperature, audio, video   a burst of samples to the sink,    the sink's receipt for enough
///                               topic: the task's name             of them is here in time
///   help                        a call for a robot (HelpCall)      a robot came: FULFILLED; given
///                                                                  up, a failure
///
/// help is among those to choose from only while there is a need for it, which comes up at given
/// times and lasts until a call for it has ended. Between two tasks the mote rests, but hardly so
/// while it needs help. The mote that is the sink receives the samples of all (SampleSink),
/// whatever else it does.
///
/// It records "p_<task>" at the start and whenever one of them moves; "succeeded_<task>" and
/// "failed_<task>", so many so far, whenever there is one more, and all of them at the end;
/// "needs", so many so far, when it comes to need help; of the sink, at the end, "samples_<task>".
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
  const std::vector<hal::ParameterMistake> mistakes_;  ///< For start().
  const double rest_, rest_in_need_;                   ///< s, on average.
  TaskWeights weights_;
  std::vector<Burst> bursts_;              ///< By task.
  const std::optional<std::size_t> help_;  ///< Its number, if it is one of the tasks.
  Recurrence needs_;
  HelpCall call_;
  Delivery delivery_;
  SampleSink received_;

  std::optional<hal::AgentId> sink_;
  std::optional<std::size_t> current_;  ///< The task; nothing: it rests.
  bool needs_help_ = false;
  int needs_so_far_ = 0;
};

}  // namespace controllers
