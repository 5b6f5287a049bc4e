#pragma once

#include <string_view>

#include "view/server/control.h"

namespace view::server {

/// Parses the body of POST /api/control. Errors: kInvalidArgument, with a message.
hal::Result<Command> command_in(std::string_view body);

}  // namespace view::server
