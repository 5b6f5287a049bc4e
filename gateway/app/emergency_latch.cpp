#include "gateway/app/emergency_latch.h"

#include <cstdlib>
#include <fstream>
#include <system_error>

#include "hal/types/log.h"

namespace gateway::app {

EmergencyLatch::EmergencyLatch(const std::string& agent) {
  // Before there are threads.
  const char* const folder = std::getenv("RUNTIME_DIRECTORY");  // NOLINT(concurrency-mt-unsafe)
  if (folder == nullptr || *folder == '\0') return;
  file_ = std::filesystem::path(folder) / (agent + ".emergency_stop");
}

bool EmergencyLatch::is_set() const {
  std::error_code error;
  return !file_.empty() && std::filesystem::exists(file_, error);
}

void EmergencyLatch::set(bool stopped) const {
  if (file_.empty()) return;
  std::error_code error;
  if (stopped) {
    if (!std::ofstream(file_)) error = std::make_error_code(std::errc::io_error);
  } else {
    std::filesystem::remove(file_, error);
  }
  if (error) {
    hal::log::warning({}, "emergency stop", "{}: {}", file_.string(), error.message());
  }
}

}  // namespace gateway::app
