#pragma once

#include <string_view>

#include "view/server/control.h"

namespace view::server {

/// What the body of POST /api/control asks for. Errors: kInvalidArgument, with what is wrong.
hal::Result<Command> command_in(std::string_view body);

}  // namespace view::server
