#pragma once

#include <string>

#include "hal/files/config/key_table.h"

namespace baraka::commands {

/// For "agents.NAME.poses[].m": last_part() is "m", mapping_of() is "agents.NAME.poses[]".
std::string last_part(const std::string& path);
std::string mapping_of(const std::string& path);

/// The values of a key: "a number with its unit (m), 0 m .. 10 m".
std::string value_words(const hal::files::config::KeyDescription& key);

/// The value that applies if the key is absent: "100 ms", "7 (disk), 31 (ideal)", "must be given";
/// empty for a mapping.
std::string default_words(const hal::files::config::KeyDescription& key);

/// The condition under which a key is allowed: "only with `profile: disk` or `ideal`, without
/// `grid`"; empty: always.
std::string condition_words(const hal::files::config::KeyDescription& key);

}  // namespace baraka::commands
