#include "programs/topics/processes.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace programs::topics {
namespace {

struct Process {
  pid_t id = 0;
  int journal = -1;  ///< End of a pipe that is read.
};

[[noreturn]] void fail_with(const char* what) {
  throw std::runtime_error(std::string(what) + ": " + std::strerror(errno));
}

bool write_all(int into, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = ::write(into, text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) return false;
    done += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
  return true;
}

std::string read_all(int from) {
  std::string text;
  std::array<char, 4096> part{};
  while (true) {
    const ssize_t count = ::read(from, part.data(), part.size());
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
    text.append(part.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
}

Process begin(std::uint32_t participant, const PlayPart& play) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail_with("pipe");
  const pid_t parent = ::getpid();
  const pid_t id = ::fork();
  if (id < 0) fail_with("fork");
  if (id == 0) {
    ::close(ends[0]);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) std::_Exit(EXIT_FAILURE);  // it ended before the line above
    std::exit(
        play(participant, [&](const std::string& journal) { return write_all(ends[1], journal); }));
  }
  ::close(ends[1]);
  return {id, ends[0]};
}

/// Until a signal asks for the end, or the first process has ended. @return the signal to pass on.
int await_end(const sigset_t& signals) {
  sigset_t all = signals;
  sigaddset(&all, SIGCHLD);
  int signal = 0;
  ::sigwait(&all, &signal);
  return signal == SIGCHLD ? SIGTERM : signal;
}

int exit_status(pid_t process) {
  constexpr int kSignalled = 128;  // as a shell has it
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  return WIFSIGNALED(status) ? kSignalled + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

int play_apart(const std::vector<std::uint32_t>& participants, const PlayPart& play,
               const sigset_t& signals, std::vector<std::string>& journals) {
  sigset_t child;
  sigemptyset(&child);
  sigaddset(&child, SIGCHLD);
  ::sigprocmask(SIG_BLOCK, &child, nullptr);
  std::vector<Process> processes;
  processes.reserve(participants.size());
  for (const std::uint32_t one : participants) processes.push_back(begin(one, play));
  const int signal = await_end(signals);
  for (const Process& one : processes) ::kill(one.id, signal);
  int worst = EXIT_SUCCESS;
  for (const Process& one : processes) {
    journals.push_back(read_all(one.journal));
    ::close(one.journal);
    worst = std::max(worst, exit_status(one.id));
  }
  return worst;
}

}  // namespace programs::topics
