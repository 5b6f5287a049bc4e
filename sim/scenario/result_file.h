#pragma once

#include <string>
#include <string_view>

#include "sim/scenario/fields.h"

namespace sim::scenario {

/// Notes a mistake of the key unless a file of the results' folder may be called so: letters,
/// digits, '_', '-' and '.', which is not the first, and something before the ending.
/// @param filled_in  the name with something in place of the words in it.
void check_result_file(Fields& io, const std::string& key, const std::string& name,
                       std::string filled_in, std::string_view ending);

}  // namespace sim::scenario
