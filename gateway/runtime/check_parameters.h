#pragma once

#include <string>
#include <vector>

#include "hal/api/controller.h"
#include "hal/node/exchange/session.h"

namespace gateway::runtime {

/// Every mistake in an agent's parameters, one line each, "file:line:column: name: what is wrong":
/// an invalid value or one out of range, an unknown name (with the nearest known one), a name given
/// twice. Empty: there are no mistakes.
std::vector<std::string> check_parameters(
    const hal::ControllerKind& kind, const std::vector<hal::node::exchange::ParameterText>& given);

/// The values, with defaults filled in. @pre check_parameters(kind, given) is empty.
hal::Parameters read_parameters(const hal::ControllerKind& kind,
                                const std::vector<hal::node::exchange::ParameterText>& given);

}  // namespace gateway::runtime
