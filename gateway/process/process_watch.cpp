#include "gateway/process/process_watch.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <optional>
#include <sstream>

#include "gateway/process/waiting.h"

namespace gateway::process {
namespace {

std::string this_host() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  // A pid means nothing outside its namespace (pid_namespaces(7)).
  struct stat pid_namespace {};
  stat("/proc/self/ns/pid", &pid_namespace);
  return fmt::format("{}#{}", name.data(), pid_namespace.st_ino);
}

}  // namespace

std::optional<std::uint64_t> start_time_of(std::int64_t pid) {
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  // Field 2 is the program's name in brackets, which may itself hold blanks and brackets.
  const std::size_t name_end = line.rfind(')');
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream rest(line.substr(name_end + 1));
  std::string skipped;
  for (int field = 3; field < 22; ++field) rest >> skipped;
  std::uint64_t start_time = 0;
  if (!(rest >> start_time)) return std::nullopt;
  return start_time;
}

ProcessIdentity this_process() {
  const pid_t pid = getpid();
  return {this_host(), pid, start_time_of(pid).value_or(0)};
}

ProcessWatch::ProcessWatch(const ProcessIdentity& watched) : local_(watched.host == this_host()) {
  if (!local_) return;
  // Not pidfd_open(): the C library's header of Debian 12 lacks extern "C".
  descriptor_ = static_cast<int>(syscall(SYS_pidfd_open, static_cast<pid_t>(watched.pid), 0));
  if (descriptor_ < 0) {
    local_ = errno == ESRCH || errno == EINVAL;  // else this kernel cannot watch processes
    return;
  }
  if (start_time_of(watched.pid) == watched.start_time) return;
  close(descriptor_);  // another process has the pid by now
  descriptor_ = -1;
}

ProcessWatch::ProcessWatch(int channel)
    : local_(true), descriptor_(fcntl(channel, F_DUPFD_CLOEXEC, 0)) {}

ProcessWatch::~ProcessWatch() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool ProcessWatch::is_dead() const {
  if (!local_) return false;
  return descriptor_ < 0 || wait_readable(std::array{descriptor_}, hal::Duration::zero());
}

std::string ProcessWatch::cause() const {
  siginfo_t info{};
  const auto id = static_cast<id_t>(descriptor_);
  // WNOWAIT: the status is left for the process that started it.
  const int result = descriptor_ < 0 ? -1 : waitid(P_PIDFD, id, &info, WEXITED | WNOWAIT | WNOHANG);
  if (result != 0 || info.si_pid == 0) return "is gone";
  if (info.si_code == CLD_EXITED) return fmt::format("exited with status {}", info.si_status);
  return fmt::format("killed by signal {}", info.si_status);
}

}  // namespace gateway::process
