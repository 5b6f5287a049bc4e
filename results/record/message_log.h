#pragma once

#include <cstdint>

#include "hal/types/message.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"
#include "results/record/database.h"

namespace results::record {

/// The tables messages and deliveries.
class MessageLog {
 public:
  explicit MessageLog(Database& database);

  void on_sent(hal::Time at, const hal::Message& message);
  /// @param transmissions  on its way.
  void on_message_delivered(hal::Time at, hal::AgentId receiver, const hal::Message& message,
                            int transmissions);
  void on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id, hal::Fate fate);
  void on_end(hal::AgentId sender, hal::MessageId id, hal::Verdict verdict);

 private:
  Statement insert_, insert_delivery_, set_fate_, set_delivered_, set_verdict_;
};

}  // namespace results::record
