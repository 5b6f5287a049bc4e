#pragma once

#include <string_view>

#include "gateway/view/control.h"

namespace gateway::view {

/// What the body of POST /api/control asks for. Errors: kInvalidArgument, with what is wrong.
hal::Result<Command> command_in(std::string_view body);

}  // namespace gateway::view
