#pragma once

#include <string>
#include <string_view>

#include "sim/scenario/fields.h"

namespace sim::scenario {

/// Notes a mistake of the key unless the name is possible for a file in the folder of results:
/// letters, digits, '_', '-' and '.', not beginning with '.', and not empty before the ending.
/// @param filled_in  the name with its placeholders replaced.
void check_result_file(Fields& io, const std::string& key, const std::string& name,
                       std::string filled_in, std::string_view ending);

}  // namespace sim::scenario
