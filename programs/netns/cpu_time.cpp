#include "programs/netns/cpu_time.h"

#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace programs::netns {
namespace {

constexpr std::int64_t kNanoseconds = 1'000'000'000;

/// Ticks of a process and of those that it has waited for; 0 if it has ended meanwhile.
std::int64_t ticks_of(const std::filesystem::path& process) {
  std::ifstream in(process / "stat");
  std::string line;
  std::getline(in, line);
  const std::size_t behind = line.rfind(')');
  if (behind == std::string::npos) return 0;
  std::istringstream fields(line.substr(behind + 1));
  constexpr int kFirst = 3, kUser = 14, kSystemOfChildren = 17;
  std::string skipped;
  for (int i = kFirst; i < kUser; ++i) fields >> skipped;
  std::int64_t sum = 0;
  for (int i = kUser; i <= kSystemOfChildren; ++i) {
    std::int64_t ticks = 0;
    fields >> ticks;
    sum += ticks;
  }
  return sum;
}

std::int64_t nanoseconds_of(const timeval& time) {
  return time.tv_sec * kNanoseconds + time.tv_usec * 1000;
}

}  // namespace

std::vector<pid_t> processes_inside() {
  std::vector<pid_t> all;
  for (const auto& process : std::filesystem::directory_iterator("/proc")) {
    const std::string name = process.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos || name == "1") continue;
    all.push_back(static_cast<pid_t>(std::stol(name)));
  }
  return all;
}

std::int64_t cpu_time_of_programs() {
  rusage ended{};
  getrusage(RUSAGE_CHILDREN, &ended);
  std::int64_t sum = nanoseconds_of(ended.ru_utime) + nanoseconds_of(ended.ru_stime);
  for (const pid_t process : processes_inside()) {
    const auto folder = std::filesystem::path("/proc") / std::to_string(process);
    sum += ticks_of(folder) * (kNanoseconds / sysconf(_SC_CLK_TCK));
  }
  return sum;
}

}  // namespace programs::netns
