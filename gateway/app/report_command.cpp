#include "gateway/app/report_command.h"

#include <fmt/format.h>

#include <filesystem>

#include "gateway/app/exit_status.h"
#include "sim/record/report.h"

namespace gateway::app {

int report(const std::vector<std::string>& folders) {
  fmt::print("{}", sim::record::report({folders.begin(), folders.end()}));
  return kDone;
}

}  // namespace gateway::app
