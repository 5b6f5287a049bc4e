#pragma once

#include <string_view>

namespace hal {

/// Whether a name matches a pattern: `*` stands for any letters, `?` for one, as in a shell.
bool matches(std::string_view pattern, std::string_view name);

}  // namespace hal
