#pragma once

#include <string_view>

#include "hal/node/exchange/session.h"
#include "hal/node/exchange/step.h"
#include "hal/types/result.h"

namespace hal::node::exchange {

/// Checks an action of a controller. gateway/runtime applies these rules when the controller calls,
/// so that it gets the error at once; hal/node/agent applies them again when the action takes
/// effect, because a message from another process may contain anything. The port ensures that an
/// action answers an event of its Step (ports.h). Thread-safe.
///
/// DriveBody     the agent has wheels; every component is finite
/// DriveWheels   one speed per wheel, none beyond the limit of the motors and none NaN
/// Send          to everyone, or to an agent (an address from 1) other than itself; numbered from
///               1; topic of 1 … kMaxTopic bytes, none of them zero; payload of 0 … kMaxPayload
/// Invalidate    topic as for Send
/// Record        a name of 1 … kMaxRecordedName bytes, none of them zero; the value is finite
/// others        always valid
///
/// Errors: kInvalidArgument, naming the field, its value and what is allowed.
Result<void> validate(const Action& action, const AgentSession& session);

/// Name of the HAL's function that makes such an action, for messages: "send".
std::string_view name(const Action& action);

}  // namespace hal::node::exchange
