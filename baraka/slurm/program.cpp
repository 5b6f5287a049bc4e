#include "baraka/slurm/program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <deque>
#include <sstream>

#include "gateway/process/limits.h"

namespace baraka::slurm {
namespace {

using Steady = std::chrono::steady_clock;

constexpr int kBetweenLooks = 100;  // ms

/// Both ends of a pipe; closes those still open at destruction.
struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() { (void)::pipe2(ends.data(), O_CLOEXEC); }
  ~Pipe() {
    close(0);
    close(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close(std::size_t end) {
    if (ends[end] >= 0) ::close(ends[end]);
    ends[end] = -1;
  }
};

/// Runs in the child process; uses only async-signal-safe functions. Never returns.
[[noreturn]] void become(const std::vector<char*>& arguments, pid_t parent, int out, int err,
                         int report) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  ::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  ::execvp(arguments[0], arguments.data());
  const int error = errno;
  (void)!::write(report, &error, sizeof error);
  ::_exit(127);
}

/// Appends the available output. @return whether there may be more.
bool take(int descriptor, std::string& text) {
  std::array<char, 4096> buffer{};
  const ssize_t size = ::read(descriptor, buffer.data(), buffer.size());
  if (size > 0) text.append(buffer.data(), static_cast<std::size_t>(size));
  return size > 0 || (size < 0 && errno == EINTR);
}

/// Reads until the program has closed both pipes or `is_over` returns true. @return whether it has
/// closed both.
bool read_all(Pipe& out, Pipe& err, Printed& printed, const std::function<bool()>& is_over) {
  out.close(1);
  err.close(1);
  while (out.ends[0] >= 0 || err.ends[0] >= 0) {
    if (is_over()) return false;
    std::array<pollfd, 2> polled{{{out.ends[0], POLLIN, 0}, {err.ends[0], POLLIN, 0}}};
    if (::poll(polled.data(), polled.size(), kBetweenLooks) <= 0) continue;
    if (polled[0].revents != 0 && !take(out.ends[0], printed.out)) out.close(0);
    if (polled[1].revents != 0 && !take(err.ends[0], printed.err)) err.close(0);
  }
  return true;
}

int status_of(pid_t pid) {
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

std::string Printed::last_error() const {
  std::istringstream lines(err);
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) last = line;
  }
  if (last.empty()) last = out.substr(0, out.find('\n'));
  if (!last.empty()) return last;
  return status > 128 ? fmt::format("killed by signal {}", status - 128)
                      : fmt::format("exited with status {}", status);
}

std::string Printed::last_errors() const {
  constexpr std::size_t kMostLines = 3;
  std::istringstream lines(err);
  std::deque<std::string> last;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) last.push_back(line);
    if (last.size() > kMostLines) last.pop_front();
  }
  return last.empty() ? last_error() : fmt::format("{}", fmt::join(last, "; "));
}

hal::Result<Printed> run_program(const std::vector<std::string>& command, hal::Duration longest,
                                 const std::function<bool(const Printed&)>& give_up) {
  std::vector<std::string> strings = command;
  std::vector<char*> arguments;
  arguments.reserve(strings.size() + 1);
  for (std::string& text : strings) arguments.push_back(text.data());
  arguments.push_back(nullptr);

  Pipe out, err, report;
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid == 0) become(arguments, parent, out.ends[1], err.ends[1], report.ends[1]);
  report.close(1);
  int error = pid < 0 ? errno : 0;
  if (pid > 0 && ::read(report.ends[0], &error, sizeof error) > 0) (void)status_of(pid);
  if (error != 0) {
    return hal::fail(hal::Errc::kNotAvailable, fmt::format("cannot start {}: {}", command[0],
                                                           gateway::process::limit_met(error)));
  }

  Printed printed;
  const auto begin = Steady::now();
  const bool in_time = read_all(out, err, printed, [&] {
    return Steady::now() - begin > longest || (give_up && give_up(printed));
  });
  if (!in_time) ::kill(-pid, SIGKILL);
  printed.status = status_of(pid);
  if (in_time) return printed;
  const std::chrono::duration<double> waited = Steady::now() - begin;
  return hal::fail(hal::Errc::kTimeout,
                   fmt::format("{}: no answer within {:.1f} s{}", command[0], waited.count(),
                               printed.err.empty() ? "" : ": " + printed.last_error()));
}

}  // namespace baraka::slurm
