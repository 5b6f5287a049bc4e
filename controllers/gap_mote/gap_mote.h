#pragma once

#include <string_view>

#include "controllers/gap_message.h"
#include "hal/api/controller.h"

namespace controllers {

/// A mote that reports to a sink, and calls out when it has lost it; or the sink itself.
///
///   SINK                                         floods a sign of life, for ever
///   CONNECTED --no sign of it for `patience`--> CUT_OFF --a sign--> CONNECTED
///
/// It reports in both states: what becomes of a report is the network's business. Times are looked
/// at once per control cycle.
class GapMote : public hal::Controller {
 public:
  GapMote(hal::Mote& mote, const hal::Parameters& parameters);

  void start() override;
  void step() override;
  void receive(const hal::Message& message) override;

 private:
  void be_sink();
  void report();
  void watch_sink();
  void say(const GapMessage& message);

  hal::Mote& mote_;
  const hal::Parameters parameters_;
  bool is_sink_ = false, is_cut_off_ = false;
  hal::AgentId sink_{};
  hal::Time heard_at_{};   ///< The sink, last.
  hal::Time report_at_{};  ///< The next one; of the sink: sign of life.
  hal::Time call_at_{};
};

}  // namespace controllers
