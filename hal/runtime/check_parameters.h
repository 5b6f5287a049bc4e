#pragma once

#include <string>
#include <vector>

#include "hal/api/controller.h"
#include "hal/exchange/session.h"

namespace hal::runtime {

/// Every mistake in an agent's parameters, one line each, "file:line:column: name: what is wrong":
/// a value that is none or out of range, a name the controller does not know (with the nearest one
/// that it does), a name given twice. Empty: all is well.
std::vector<std::string> check_parameters(const ControllerKind& kind,
                                          const std::vector<exchange::ParameterText>& given);

/// The values, defaults filled in. @pre check_parameters(kind, given) found nothing.
Parameters read_parameters(const ControllerKind& kind,
                           const std::vector<exchange::ParameterText>& given);

}  // namespace hal::runtime
