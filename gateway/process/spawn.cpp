#include "gateway/process/spawn.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "gateway/process/limits.h"

namespace gateway::process {
namespace {

constexpr std::chrono::seconds kGrace{2};

/// Everything a child needs, made before the fork: between fork and exec only calls that are safe
/// in a signal handler are allowed, because other threads may have held locks.
struct Prepared {
  std::string program;
  std::vector<std::string> strings;
  std::vector<char*> arguments;
  std::vector<std::string> variables;
  std::vector<char*> environment;
  int log = -1;
  pid_t parent = 0;
};

std::vector<char*> pointers_to(std::vector<std::string>& strings) {
  std::vector<char*> pointers;
  pointers.reserve(strings.size() + 1);
  for (std::string& text : strings) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::vector<std::string> environment_for(int domain) {
  constexpr std::string_view kVariable = "BARAKA_DOMAIN=";
  std::vector<std::string> variables;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (!std::string_view(*entry).starts_with(kVariable)) variables.emplace_back(*entry);
  }
  variables.push_back(std::string(kVariable) + std::to_string(domain));
  return variables;
}

void prepare(const Command& command, Prepared& prepared) {
  prepared.program = command.program.string();
  prepared.strings = command.arguments;
  prepared.strings.insert(prepared.strings.begin(), prepared.program);
  prepared.arguments = pointers_to(prepared.strings);
  prepared.variables = environment_for(command.domain);
  prepared.environment = pointers_to(prepared.variables);
  prepared.parent = getpid();
  prepared.log = open(command.log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (prepared.log < 0) {
    throw std::runtime_error(fmt::format("{}: {}", command.log.string(), limit_met(errno)));
  }
}

/// Runs in the child. Writes errno to `report` if the program cannot be started.
[[noreturn]] void become(const Prepared& prepared, int report) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != prepared.parent) _exit(127);  // the parent died before the line above
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int input = open("/dev/null", O_RDONLY);
  dup2(input, STDIN_FILENO);
  dup2(prepared.log, STDOUT_FILENO);
  dup2(prepared.log, STDERR_FILENO);
  // Fast DDS opens its sockets without O_CLOEXEC: the program would keep our ports in use.
  close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  execve(prepared.program.c_str(), prepared.arguments.data(), prepared.environment.data());
  const int error = errno;
  [[maybe_unused]] const ssize_t written = write(report, &error, sizeof error);
  _exit(127);
}

/// The child's errno; 0 if exec succeeded, which closes the child's end.
int exec_error(int report) {
  int error = 0;
  while (read(report, &error, sizeof error) < 0 && errno == EINTR) continue;
  return error;
}

pid_t fork_and_exec(const Prepared& prepared) {
  int report[2];
  if (pipe2(report, O_CLOEXEC) != 0) {
    throw std::runtime_error(
        fmt::format("cannot start {}: {}", prepared.program, limit_met(errno)));
  }
  const pid_t pid = fork();
  if (pid == 0) become(prepared, report[1]);
  const int fork_error = pid < 0 ? errno : 0;
  close(report[1]);
  const int error = fork_error != 0 ? fork_error : exec_error(report[0]);
  close(report[0]);
  if (error == 0) return pid;
  if (pid > 0) waitpid(pid, nullptr, 0);
  throw std::runtime_error(fmt::format("cannot start {}: {}", prepared.program, limit_met(error)));
}

bool has_ended(int descriptor) {
  pollfd polled{descriptor, POLLIN, 0};
  return hal::poll_for({&polled, 1}, hal::Duration::zero()) > 0;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Leaves the process to be reaped later. @pre it has ended.
Ending ending_of(const std::string& name, pid_t pid) {
  siginfo_t info{};
  while (waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
    continue;
  }
  if (info.si_code == CLD_EXITED) {
    return {name, pid, info.si_status, fmt::format("exited with status {}", info.si_status), 0};
  }
  return {name, pid, 128 + info.si_status, fmt::format("killed by signal {}", info.si_status), 0};
}

}  // namespace

std::string last_words(const std::filesystem::path& log) {
  std::ifstream file(log);
  std::string last;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty()) last = ": " + line;
  }
  return last;
}

Spawner::~Spawner() { stop_all(); }

pid_t Spawner::start(const Command& command) {
  Prepared prepared;
  prepare(command, prepared);
  pid_t pid = -1;
  try {
    pid = fork_and_exec(prepared);
  } catch (...) {
    close(prepared.log);
    throw;
  }
  close(prepared.log);
  setpgid(pid, pid);  // also here, in case the child has not done it yet; fails after its exec
  const int descriptor = static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
  const bool is_named = !command.name.empty();
  children_.push_back({is_named ? command.name : command.program.filename().string(), command.log,
                       pid, descriptor});
  return pid;
}

hal::Result<void> Spawner::check() const {
  for (const Child& child : children_) {
    if (!has_ended(child.descriptor)) continue;
    return hal::fail(hal::Errc::kNotConnected, end_of(child, child.log));
  }
  return {};
}

std::string Spawner::end_of(const Child& child, const std::filesystem::path& log) {
  return fmt::format("{} (pid {}) {}{}; see {}", child.name, child.pid,
                     ending_of(child.name, child.pid).cause, last_words(log), log.string());
}

std::vector<std::string> Spawner::killed(const std::filesystem::path& logs) const {
  std::vector<std::string> lines;
  for (const Child& child : children_) {
    if (!has_ended(child.descriptor)) continue;
    if (!ending_of(child.name, child.pid).cause.starts_with("killed")) continue;
    lines.push_back(end_of(child, logs / child.log.filename()));
  }
  return lines;
}

void Spawner::wait_all(hal::Duration timeout) {
  const hal::Time end = clock_.now() + timeout;
  for (const Child& child : children_) {
    pollfd polled{child.descriptor, POLLIN, 0};
    clock_.wait({&polled, 1}, std::max(end - clock_.now(), hal::Duration::zero()));
  }
}

void Spawner::ask_to_end() const {
  for (const Child& child : children_) {
    if (!has_ended(child.descriptor)) kill(child.pid, SIGTERM);
  }
}

std::vector<Ending> Spawner::stop_all() {
  ask_to_end();
  wait_all(kGrace);
  std::vector<Ending> endings;
  for (const Child& child : children_) {
    if (!has_ended(child.descriptor)) kill(child.pid, SIGKILL);
    endings.push_back(ending_of(child.name, child.pid));  // waits until it has ended
    rusage used{};
    wait4(child.pid, nullptr, 0, &used);
    endings.back().user_s = seconds(used.ru_utime) + seconds(used.ru_stime);
    close(child.descriptor);
  }
  children_.clear();
  return endings;
}

}  // namespace gateway::process
