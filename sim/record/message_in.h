#pragma once

#include <optional>

#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "sim/radio/mac_sap.h"

namespace sim::record {

/// A message of a controller, as the tables name it.
struct MessageName {
  hal::AgentId sender;
  hal::MessageId id = 0;
};

/// The message that a frame from `source` carries for agents; none: it carries something else.
std::optional<MessageName> message_in(const radio::MacRequest& request, hal::AgentId source);

}  // namespace sim::record
