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
/// kDriveBody    the agent has wheels; every component is finite
/// kDriveWheels  one speed per wheel, none beyond the limit of the motors (NaN is)
/// kSend         to everyone, or to an agent (an address from 1) other than itself; numbered from
///               1; topic of 1 … kMaxTopic bytes, none of them zero; payload of 0 … kMaxPayload
/// kInvalidate   the topic likewise
/// kRecord       a name of 1 … kMaxRecordedName bytes, none of them zero; the value is finite
/// others        always
///
/// Errors: kInvalidArgument, naming the field, what it is and what is allowed.
Result<void> validate(const Action& action, const AgentSession& session);

/// The call of the HAL that makes actions of that kind, for messages: "send".
std::string_view name(ActionKind kind);

}  // namespace hal::node::exchange
