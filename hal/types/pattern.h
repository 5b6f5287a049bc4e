#pragma once

#include <string_view>

namespace hal {

/// Whether a name matches a pattern as in a shell: `*` stands for any number of characters, `?` for
/// one.
bool matches(std::string_view pattern, std::string_view name);

/// Whether some name matches both patterns.
bool overlap(std::string_view one, std::string_view other);

}  // namespace hal
