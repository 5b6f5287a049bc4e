#pragma once

#include <string>
#include <vector>

namespace gateway {

/// Prints the tables of one or many results; or, if `page` names a file, writes the figures to it.
/// @return exit status. @throws std::runtime_error
int report(const std::vector<std::string>& folders, const std::string& page);

}  // namespace gateway
