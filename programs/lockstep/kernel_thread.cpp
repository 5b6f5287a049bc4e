#include "programs/lockstep/kernel_thread.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

namespace programs::lockstep {
namespace {

using Text = std::array<char, 512>;

std::string_view read_at_begin(int file, Text& text) {
  const ssize_t length = file < 0 ? -1 : pread(file, text.data(), text.size(), 0);
  return {text.data(), static_cast<std::size_t>(std::max<ssize_t>(0, length))};
}

netns::FileDescriptor opened(const std::string& path) {
  return netns::FileDescriptor(open(path.c_str(), O_RDONLY | O_CLOEXEC));
}

/// Where threads wait for others: system calls of the library in programs/waits. Not those in which
/// they wait for a disk.
bool is_wait_for_others(std::string_view function) {
  static constexpr std::array<std::string_view, 10> kFunctions{
      "futex",   "poll_",      "do_poll",         "do_select", "do_wait",
      "do_sigt", "sigsuspend", "__do_semtimedop", "do_msgrcv", "wait_for_partner"};
  return std::ranges::any_of(kFunctions,
                             [&](std::string_view one) { return function.starts_with(one); });
}

/// The state behind the name, which is in parentheses and may hold some itself.
char state_in(std::string_view stat) {
  const std::size_t end = stat.rfind(')');
  return end == std::string_view::npos || end + 2 >= stat.size() ? 'X' : stat[end + 2];
}

std::optional<pid_t> number_of(const std::filesystem::path& path) {
  const std::string name = path.filename();
  pid_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc{} || end != name.data() + name.size()) return std::nullopt;
  return number;
}

/// The number that a thread has in the innermost of its namespaces; 0: it has ended.
pid_t innermost_number(const std::filesystem::path& task) {
  std::ifstream status(task / "status");
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with("NSpid:")) continue;
    return static_cast<pid_t>(std::strtol(line.c_str() + line.rfind('\t'), nullptr, 10));
  }
  return 0;
}

/// The first task in a folder of /proc for which this holds; 0: there is none, or no such folder. A
/// folder that changes while it is read is read again.
template <class Holds>
pid_t first_task(const std::filesystem::path& folder, const Holds& holds) {
  constexpr int kTries = 5;
  for (int tries = 0; tries < kTries; ++tries) {
    std::error_code error;
    std::filesystem::directory_iterator entry(folder, error);
    if (error) return 0;
    for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
      const auto number = number_of(entry->path());
      if (number && holds(entry->path())) return *number;
    }
    if (!error) return 0;
  }
  return 0;
}

// NS_GET_PID_FROM_PIDNS and NS_GET_TGID_FROM_PIDNS of linux/nsfs.h, which Debian 12's has not yet.
constexpr unsigned long kThreadFromSpace = _IOR(0xb7, 0x6, int),
                        kProcessFromSpace = _IOR(0xb7, 0x7, int);

/// A number of this process's namespace for one of another; 0: there is no such thread. None: the
/// kernel does not translate.
std::optional<pid_t> translated(const netns::FileDescriptor& space, unsigned long what,
                                pid_t number) {
  const int found = ioctl(space.get(), what, number);
  if (found < 0 && errno == ENOTTY) return std::nullopt;
  return std::max(found, 0);
}

}  // namespace

KernelThread::KernelThread(pid_t process, pid_t thread)
    : process_(process),
      thread_(thread),
      wchan_(opened(file("wchan"))),
      stat_(opened(file("stat"))),
      syscall_(opened(file("syscall"))) {}

std::string KernelThread::file(const char* name) const {
  return fmt::format("/proc/{}/task/{}/{}", process_, thread_, name);
}

KernelState KernelThread::look() const {
  Text text{};
  if (is_wait_for_others(read_at_begin(wchan_.get(), text))) return KernelState::kAsleep;
  const std::string_view stat = read_at_begin(stat_.get(), text);
  const char state = stat.empty() ? 'X' : state_in(stat);
  if (state == 'X' || state == 'Z') return KernelState::kGone;
  if (state == 'T') return KernelState::kStopped;
  if (state != 'S') return KernelState::kAwake;
  read_at_begin(syscall_.get(), text);
  return read_at_begin(wchan_.get(), text).starts_with('0') ? KernelState::kAwake
                                                            : KernelState::kAsleep;
}

std::string KernelThread::name() const {
  std::string name;
  std::getline(std::ifstream(file("comm")), name);
  return name.empty() ? "a program" : name;
}

std::string KernelThread::call() const {
  Text call{}, function{};
  const std::string_view number = read_at_begin(syscall_.get(), call);
  return fmt::format("system call {} (wchan {})", number.substr(0, number.find(' ')),
                     read_at_begin(wchan_.get(), function));
}

std::string KernelThread::debugger() const {
  constexpr std::string_view kTracer = "TracerPid:\t";
  Text text{};
  if (const auto stat = read_at_begin(stat_.get(), text); stat.empty() || state_in(stat) != 't')
    return {};
  std::ifstream status(file("status"));
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with(kTracer)) continue;
    const std::string process = line.substr(kTracer.size());
    std::string name;
    std::getline(std::ifstream(fmt::format("/proc/{}/comm", process)), name);
    return fmt::format("{} (process {})", name, process);
  }
  return {};
}

AgentTasks::AgentTasks(netns::FileDescriptor processes)
    : processes_(std::move(processes)),
      translates_(translated(processes_, kProcessFromSpace, 1).has_value()) {}

pid_t AgentTasks::outside(pid_t process) {
  if (translates_) return *translated(processes_, kProcessFromSpace, process);
  pid_t& known = outside_[process];
  if (known == 0) known = searched(process);
  const pid_t found = known;
  if (found == 0) outside_.erase(process);
  return found;
}

/// Number outside; 0: there is no such process.
pid_t AgentTasks::searched(pid_t process) const {
  struct stat own {};
  fstat(processes_.get(), &own);
  return first_task("/proc", [&](const std::filesystem::path& task) {
    struct stat space {};
    return stat((task / "ns/pid").c_str(), &space) == 0 && space.st_ino == own.st_ino &&
           innermost_number(task) == process;
  });
}

/// @param process  number outside; @param thread  inside. @return number outside; 0: it has ended.
pid_t AgentTasks::thread_outside(pid_t process, pid_t thread) const {
  if (!translates_) {
    return first_task(
        fmt::format("/proc/{}/task", process),
        [&](const std::filesystem::path& task) { return innermost_number(task) == thread; });
  }
  const bool is_of_process = *translated(processes_, kProcessFromSpace, thread) == process;
  return is_of_process ? *translated(processes_, kThreadFromSpace, thread) : 0;
}

bool AgentTasks::has_ended(pid_t process) {
  const pid_t number = outside(process);
  const auto is_left = [](const std::filesystem::path& task) {
    Text text{};
    const netns::FileDescriptor stat = opened(task / "stat");
    const std::string_view read = read_at_begin(stat.get(), text);
    return !read.empty() && state_in(read) != 'Z' && state_in(read) != 'X';
  };
  return number == 0 || first_task(fmt::format("/proc/{}/task", number), is_left) == 0;
}

KernelThread AgentTasks::find(pid_t process, pid_t thread) {
  const pid_t number = outside(process);
  if (number == 0) return {};
  const pid_t found = thread_outside(number, thread);
  if (found == 0) forget(process);  // its number may be another one's by now
  return found == 0 ? KernelThread() : KernelThread(number, found);
}

}  // namespace programs::lockstep
