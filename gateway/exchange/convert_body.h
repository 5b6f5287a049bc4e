#pragma once

#include "gateway/exchange/convert.h"
#include "gateway/exchange/ranges.h"
#include "hal/types/robot_body.h"

namespace gateway::exchange {

/// Writes a robot's body into the session of its agent.
void put_body(const hal::RobotBody& body, wire::AgentSession& session);

/// @param ranges  remembers an unknown shape.
hal::RobotBody body_from_wire(const wire::AgentSession& session, Ranges& ranges);

}  // namespace gateway::exchange
