#pragma once

#include <string_view>

#include "hal/node/exchange/session.h"
#include "hal/node/exchange/step.h"
#include "hal/types/result.h"

namespace hal::node::exchange {

/// What a controller asks for is judged by these rules and no others: by gateway/runtime when it
/// calls, so that it is told at once, and by hal/node/agent when the action takes effect, as
/// anybody may have written what came over a wire. That an action answers an event of its Step is
/// for the port to see to (ports.h). Thread-safe.
///
/// DriveBody     the agent has wheels; every component is finite
/// DriveWheels   one speed per wheel, none beyond the limit of the motors (NaN is)
/// Send          to everyone, or to an agent (an address from 1) other than itself; numbered from
///               1; topic of 1 … kMaxTopic bytes, none of them zero; payload of 0 … kMaxPayload
/// Invalidate    the topic likewise
/// Record        a name of 1 … kMaxRecordedName bytes, none of them zero; the value is finite
/// others        always
///
/// Errors: kInvalidArgument, naming the field, what it is and what is allowed.
Result<void> validate(const Action& action, const AgentSession& session);

/// The call of the HAL that makes such an action, for messages: "send".
std::string_view name(const Action& action);

}  // namespace hal::node::exchange
