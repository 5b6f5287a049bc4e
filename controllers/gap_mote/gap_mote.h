#pragma once

#include <string_view>

#include "controllers/gap_message.h"
#include "hal/api/controller.h"

namespace controllers {

/// A mote that sends reports to a sink, and calls when it has lost contact; or the sink itself.
///
///   SINK                                         floods a sign of life periodically
///   CONNECTED --no sign of it for `patience`--> CUT_OFF --a sign--> CONNECTED
///
/// It sends reports in both states; the network decides their fate. Time-outs are checked once per
/// control cycle.
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
  hal::Time heard_at_{};   ///< Time of the sink's last sign of life.
  hal::Time report_at_{};  ///< Time of the next report; for the sink, of its next sign of life.
  hal::Time call_at_{};
};

}  // namespace controllers
