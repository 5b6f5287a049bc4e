#pragma once

#include <string>

#include "hal/files/config/key_table.h"

namespace baraka::commands {

/// "m" of "agents.NAME.poses[].m"; "agents.NAME.poses[]".
std::string last_part(const std::string& path);
std::string mapping_of(const std::string& path);

/// "a number with its unit (m), 0 m .. 10 m".
std::string value_words(const hal::files::config::KeyDescription& key);

/// What counts when it is absent: "100 ms", "7 (disk), 31 (ideal)", "must be given"; empty for a
/// mapping.
std::string default_words(const hal::files::config::KeyDescription& key);

/// "only with `profile: disk` or `ideal`, without `grid`"; empty: always.
std::string condition_words(const hal::files::config::KeyDescription& key);

}  // namespace baraka::commands
