#pragma once

#include <string>
#include <vector>

namespace gateway::app {

/// Prints the tables of one or many results. @return exit status. @throws std::runtime_error
int report(const std::vector<std::string>& folders);

}  // namespace gateway::app
