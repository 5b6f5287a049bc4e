// Processes: POSIX.1-2017, <unistd.h>, <spawn.h>, <sys/wait.h>, <stdlib.h>, <stdio.h>; wait4(2).
// Each that is started has a slot before it exists, so that the run waits for it.
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/cancellation.h"
#include "programs/waits/descriptors.h"
#include "programs/waits/entropy.h"
#include "programs/waits/turn.h"

namespace {

using programs::waits::own_slot;
using programs::waits::WaitSlot;

/// An environment in which a program finds its slot, and what makes it one of the run's.
class Environment {
 public:
  Environment(char* const* given, const WaitSlot& slot) {
    const auto number = &slot - programs::waits::page()->slots.data();
    std::snprintf(slot_.data(), slot_.size(), "%s=%td", programs::netns::kSlotVariable, number);
    std::size_t count = 0;
    while (given != nullptr && given[count] != nullptr) ++count;
    variables_ = static_cast<char**>(std::calloc(count + kMore, sizeof(char*)));
    if (variables_ == nullptr) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (!is(given[i], programs::netns::kSlotVariable)) variables_[kept++] = given[i];
    }
    variables_[kept++] = slot_.data();
    for (const char* const name : kOfRun) {
      char* const own = own_variable(name);
      if (own != nullptr && !has(name)) variables_[kept++] = own;
    }
  }
  ~Environment() { std::free(variables_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

  char** get() const { return variables_; }

 private:
  static constexpr std::array<const char*, 3> kOfRun{"LD_PRELOAD", "BARAKA_ROOM",
                                                     "BARAKA_DILATION"};
  static constexpr std::size_t kMore = kOfRun.size() + 2;

  static bool is(const char* variable, const char* name) {
    const std::size_t length = std::strlen(name);
    return std::strncmp(variable, name, length) == 0 && variable[length] == '=';
  }
  static char* own_variable(const char* name) {
    for (char** one = environ; one != nullptr && *one != nullptr; ++one) {
      if (is(*one, name)) return *one;
    }
    return nullptr;
  }
  bool has(const char* name) const {
    for (char** one = variables_; *one != nullptr; ++one) {
      if (is(*one, name)) return true;
    }
    return false;
  }

  std::array<char, 32> slot_{};
  char** variables_ = nullptr;
};

/// @param call  with the environment to be used. @return its error.
template <class Call>
int start(pid_t* process, char* const* environment, const Call& call) {
  WaitSlot& slot = programs::waits::expect_one();
  const Environment variables(environment, slot);
  pid_t unasked = 0;
  pid_t* const number = process != nullptr ? process : &unasked;
  const int error = variables.get() == nullptr ? ENOMEM : call(number, variables.get());
  if (error != 0) {
    programs::waits::give_back_slot(slot);
  } else {
    programs::waits::expected_is(slot, *number);
  }
  return error;
}

/// Waits for a child, or until a handler has run.
template <class Call>
auto wait_for_child(int flags, const Call& call) {
  programs::waits::cancellation_point();
  const auto at_once = call(flags | WNOHANG);
  if (at_once != 0 || (flags & WNOHANG) != 0 || own_slot() == nullptr) return at_once;
  programs::waits::KernelWait wait(programs::waits::kNever);
  const auto result = call(flags);
  wait.end();
  programs::waits::cancellation_point();
  return result;
}

pid_t start_shell(const char* command, posix_spawn_file_actions_t* actions) {
  std::array<char, 3> shell{"sh"}, option{"-c"};
  const std::array<char*, 4> arguments{shell.data(), option.data(), const_cast<char*>(command),
                                       nullptr};
  pid_t process = -1;
  errno = posix_spawn(&process, "/bin/sh", actions, nullptr, arguments.data(), environ);
  return errno == 0 ? process : -1;
}

/// What popen() has started, by its stream. Never destroyed: streams outlive it.
std::map<FILE*, pid_t>& shells() {
  static auto* const all = new std::map<FILE*, pid_t>;
  return *all;
}

}  // namespace

BARAKA_EXPORTED pid_t fork() noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(fork)();
  WaitSlot& slot = programs::waits::expect_one();
  const pid_t child = BARAKA_NEXT(fork)();
  if (child < 0) programs::waits::give_back_slot(slot);
  if (child > 0) programs::waits::expected_is(slot, child);  // it may be killed before it says
  if (child == 0) {
    programs::waits::forget_own_slot();
    programs::waits::adopt(slot);
    programs::waits::draw_anew();
  }
  return child;
}

/// The parent does not stand still meanwhile: nothing is promised of that.
BARAKA_EXPORTED pid_t vfork() noexcept { return fork(); }

// POSIX gives them six parameters.
// NOLINTNEXTLINE(readability-function-size)
BARAKA_EXPORTED int posix_spawn(pid_t* __restrict process, const char* __restrict path,
                                const posix_spawn_file_actions_t* __restrict actions,
                                const posix_spawnattr_t* __restrict attributes,
                                char* const arguments[], char* const environment[]) {
  const auto next = BARAKA_NEXT(posix_spawn);
  if (own_slot() == nullptr) {
    return next(process, path, actions, attributes, arguments, environment);
  }
  return start(process, environment, [=](pid_t* number, char** variables) {
    return next(number, path, actions, attributes, arguments, variables);
  });
}

// NOLINTNEXTLINE(readability-function-size)
BARAKA_EXPORTED int posix_spawnp(pid_t* process, const char* name,
                                 const posix_spawn_file_actions_t* actions,
                                 const posix_spawnattr_t* attributes, char* const arguments[],
                                 char* const environment[]) {
  const auto next = BARAKA_NEXT(posix_spawnp);
  if (own_slot() == nullptr) {
    return next(process, name, actions, attributes, arguments, environment);
  }
  return start(process, environment, [=](pid_t* number, char** variables) {
    return next(number, name, actions, attributes, arguments, variables);
  });
}

BARAKA_EXPORTED pid_t wait4(pid_t process, int* status, int options, rusage* usage) {
  return wait_for_child(options,
                        [=](int with) { return BARAKA_NEXT(wait4)(process, status, with, usage); });
}

BARAKA_EXPORTED pid_t waitpid(pid_t process, int* status, int options) {
  return wait4(process, status, options, nullptr);
}

BARAKA_EXPORTED pid_t wait(int* status) { return wait4(-1, status, 0, nullptr); }

BARAKA_EXPORTED pid_t wait3(int* status, int options, rusage* usage) {
  return wait4(-1, status, options, usage);
}

BARAKA_EXPORTED int waitid(idtype_t kind, id_t process, siginfo_t* info, int options) {
  const auto next = BARAKA_NEXT(waitid);
  if (own_slot() == nullptr || info == nullptr || (options & WNOHANG) != 0) {
    return next(kind, process, info, options);
  }
  info->si_pid = 0;
  const int status = next(kind, process, info, options | WNOHANG);
  if (status != 0 || info->si_pid != 0) return status;
  programs::waits::KernelWait wait(programs::waits::kNever);
  const int result = next(kind, process, info, options);
  wait.end();
  return result;
}

BARAKA_EXPORTED int system(const char* command) {
  if (own_slot() == nullptr || command == nullptr) return BARAKA_NEXT(system)(command);
  struct sigaction ignored {
  }, before_interrupt{}, before_quit{};
  ignored.sa_handler = SIG_IGN;
  sigaction(SIGINT, &ignored, &before_interrupt);
  sigaction(SIGQUIT, &ignored, &before_quit);
  const pid_t shell = start_shell(command, nullptr);
  int status = -1;
  while (shell > 0 && waitpid(shell, &status, 0) < 0 && errno == EINTR) continue;
  sigaction(SIGINT, &before_interrupt, nullptr);
  sigaction(SIGQUIT, &before_quit, nullptr);
  return status;
}

BARAKA_EXPORTED FILE* popen(const char* command, const char* mode) {
  if (own_slot() == nullptr) return BARAKA_NEXT(popen)(command, mode);
  const bool is_read = std::strchr(mode, 'r') != nullptr;
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return nullptr;
  const int ours = is_read ? ends[0] : ends[1], theirs = is_read ? ends[1] : ends[0];
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, theirs, is_read ? STDOUT_FILENO : STDIN_FILENO);
  const pid_t shell = start_shell(command, &actions);
  posix_spawn_file_actions_destroy(&actions);
  close(theirs);
  FILE* const stream = shell > 0 ? fdopen(ours, is_read ? "r" : "w") : nullptr;
  if (stream == nullptr) {
    close(ours);
    return nullptr;
  }
  if (std::strchr(mode, 'e') == nullptr) fcntl(ours, F_SETFD, 0);
  shells()[stream] = shell;
  return stream;
}

BARAKA_EXPORTED int pclose(FILE* stream) {
  const auto found = own_slot() == nullptr ? shells().end() : shells().find(stream);
  if (own_slot() == nullptr || found == shells().end()) return BARAKA_NEXT(pclose)(stream);
  const pid_t shell = found->second;
  shells().erase(found);
  std::fclose(stream);
  int status = -1;
  while (waitpid(shell, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return status;
}
