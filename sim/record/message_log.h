#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "hal/types/message.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"
#include "sim/radio/frame.h"
#include "sim/record/database.h"

namespace sim::record {

/// The tables messages and deliveries.
class MessageLog {
 public:
  explicit MessageLog(Database& database);

  void on_sent(hal::Time at, const hal::Message& message);
  /// A frame's payload goes up at `receiver`: if it is a message at the end of its way, this is
  /// where the number of its transmissions can be seen. Comes before on_message_delivered.
  void on_frame_delivered(const radio::Frame& frame, hal::AgentId receiver);
  void on_message_delivered(hal::Time at, hal::AgentId receiver, const hal::Message& message);
  void on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id, hal::Fate fate);
  void on_end(hal::AgentId sender, hal::MessageId id, hal::Verdict verdict);

 private:
  struct Arriving {
    hal::AgentId receiver, sender;
    hal::MessageId id = 0;
    std::uint8_t transmissions = 0;
  };
  std::optional<int> transmissions_of(hal::AgentId receiver, const hal::Message& message) const;

  Statement insert_, insert_delivery_, set_fate_, set_delivered_, set_verdict_;
  std::optional<Arriving> arriving_;
};

}  // namespace sim::record
