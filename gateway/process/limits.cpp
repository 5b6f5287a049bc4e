#include "gateway/process/limits.h"

#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace gateway::process {
namespace {

/// Measured: 3 per process (two to detect its death, one to detect that it has answered), and 40
/// for DDS, results and logs. The rest is a reserve.
constexpr rlim_t kFilesPerProcess = 4;
constexpr rlim_t kFilesOfOurOwn = 64;
constexpr int kThreadsPerProcess = 6;

std::string text_of(rlim_t limit) {
  return limit == RLIM_INFINITY ? std::string("unlimited") : fmt::format("{}", limit);
}

}  // namespace

void make_room_for(std::size_t processes) {
  const rlim_t needed = kFilesOfOurOwn + kFilesPerProcess * processes;
  rlimit files{};
  if (getrlimit(RLIMIT_NOFILE, &files) != 0 || files.rlim_cur >= needed) return;
  rlimit raised = files;
  raised.rlim_cur = std::min(needed, files.rlim_max);
  setrlimit(RLIMIT_NOFILE, &raised);
  if (raised.rlim_cur >= needed) return;
  throw std::runtime_error(fmt::format(
      "{} controller processes need {} open files, the limit is {}: raise it with 'ulimit -Hn {}' "
      "as root, in /etc/security/limits.conf or with LimitNOFILE= of the service, or give the "
      "groups of the scenario fewer 'processes'",
      processes, needed, text_of(files.rlim_max), needed));
}

std::string limit_met(int error) {
  std::string what = std::strerror(error);
  rlimit limit{};
  if (error == EAGAIN && getrlimit(RLIMIT_NPROC, &limit) == 0) {
    return fmt::format(
        "{}: a limit of processes and threads is met, of which each controller takes {}: that of "
        "this user is {} ('ulimit -u'), that of a container or service is in pids.max (TasksMax=). "
        "Raise it, or give the groups of the scenario fewer 'processes'",
        what, kThreadsPerProcess, text_of(limit.rlim_cur));
  }
  if (error == EMFILE && getrlimit(RLIMIT_NOFILE, &limit) == 0) {
    return fmt::format("{}: the limit is {}, raise it with 'ulimit -n'", what,
                       text_of(limit.rlim_cur));
  }
  if (error == ENFILE) return what + ": the limit of the whole machine, fs.file-max of sysctl";
  if (error == ENOMEM) return what + ": each controller takes about 5 MB";
  return what;
}

}  // namespace gateway::process
