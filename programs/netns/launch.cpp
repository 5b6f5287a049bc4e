#include "programs/netns/launch.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/personality.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <optional>

#include "programs/netns/pipe.h"
#include "programs/netns/shown.h"
#include "programs/netns/wait_page.h"

namespace programs::netns {
namespace {

constexpr int kFirstInherited = STDERR_FILENO + 1;

std::optional<rlimit> limit_before;  // set by raise_descriptor_limit()

/// Moves a descriptor above the target numbers, so that no assignment overwrites one that is still
/// to be moved.
int moved_up(int descriptor, int above) {
  const int moved = fcntl(descriptor, F_DUPFD_CLOEXEC, above);
  if (moved < 0) fail("a descriptor of the program");
  return moved;
}

void put_at(int descriptor, int place, int flags = 0) {
  if (dup3(descriptor, place, flags) < 0) fail("a descriptor of the program");
}

/// The descriptors that a program gets, followed by those on which its starter reports the reason
/// of a failure and the process id. All others are closed, because other programs inside must not
/// find them there.
struct Descriptors {
  int log;
  const std::vector<int>& inherited;
  int report, number;
};

void take_descriptors(Descriptors& all) {
  const int report = kFirstInherited + static_cast<int>(all.inherited.size()), number = report + 1;
  const int above = number + 1;
  std::vector<int> moved;
  moved.reserve(all.inherited.size());
  for (const int one : all.inherited) moved.push_back(moved_up(one, above));
  const int log = moved_up(all.log, above), moved_number = moved_up(all.number, above);
  put_at(moved_up(all.report, above), report, O_CLOEXEC);
  all.report = report;
  put_at(moved_number, number, O_CLOEXEC);
  all.number = number;
  put_at(moved_up(open("/dev/null", O_RDONLY | O_CLOEXEC), above), STDIN_FILENO);
  put_at(log, STDOUT_FILENO);
  put_at(log, STDERR_FILENO);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    put_at(moved[i], kFirstInherited + static_cast<int>(i));
  }
  close_range(static_cast<unsigned>(above), ~0U, 0);
}

/// Runs in the program's process, which is in the agent already.
void become_leader(const Launch& launch) {
  setsid();
  if (chdir(launch.folder.c_str()) != 0) fail(launch.folder);
  become(launch);
  fail(launch.program);
}

/// Runs in a child, which stays outside of the agent until it has no descriptors open that others
/// inside must not see. The process that it starts is a child of its own parent: clone(2),
/// CLONE_PARENT.
[[noreturn]] void start_in(const Launch& launch, const AgentSpaces& spaces,
                           Descriptors descriptors) {
  try {
    Shown shown;
    for (const std::string& one : launch.shown) shown.add(one);
    shown.add_folder_of(launch.program);
    enter(spaces);
    shown.put();
    take_descriptors(descriptors);
    const long child =
        syscall(SYS_clone, CLONE_PARENT | SIGCHLD, nullptr, nullptr, nullptr, nullptr);
    if (child < 0) fail("a process of the agent");
    if (child == 0) become_leader(launch);
    const auto number = static_cast<pid_t>(child);
    (void)!write(descriptors.number, &number, sizeof number);
  } catch (const std::exception& error) {
    (void)!write(descriptors.report, error.what(), std::strlen(error.what()));
  }
  _exit(127);
}

std::string_view name_of(std::string_view variable) {
  return variable.substr(0, variable.find('='));
}

/// Whether the environment is one of lock-step.
bool is_held(const std::vector<std::string>& environment) {
  return std::ranges::any_of(environment,
                             [](const std::string& one) { return name_of(one) == kSlotVariable; });
}

/// Whether the environment slows time: see inside(). No factor exceeds 1.
bool is_slowed(const std::vector<std::string>& environment) {
  constexpr std::string_view kVariable = "BARAKA_DILATION=";
  return std::ranges::any_of(environment, [kVariable](const std::string& one) {
    return one.starts_with(kVariable) && one.substr(kVariable.size(), 1) != "1";
  });
}

}  // namespace

std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<char*> all;
  all.reserve(texts.size() + 1);
  for (const std::string& text : texts) all.push_back(const_cast<char*>(text.c_str()));
  all.push_back(nullptr);
  return all;
}

void become(const Launch& launch) {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  signal(SIGPIPE, SIG_DFL);
  if (limit_before) setrlimit(RLIMIT_NOFILE, &*limit_before);
  // A program that gets another user or more rights from its file does not load the library:
  // ld.so(8).
  if (is_slowed(launch.environment) || is_held(launch.environment))
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  // Equal runs have equal addresses: some programs order things by them.
  if (is_held(launch.environment)) personality(ADDR_NO_RANDOMIZE);
  execve(launch.program.c_str(), pointers_to(launch.arguments).data(),
         pointers_to(launch.environment).data());
}

pid_t launch(const Launch& launch, const AgentSpaces& spaces, int log,
             const std::vector<int>& inherited) {
  Pipe report, number;
  const pid_t starter = fork();
  if (starter < 0) fail(launch.program);
  if (starter == 0) {
    start_in(launch, spaces, {log, inherited, report.writer.get(), number.writer.get()});
  }
  report.writer.reset();
  number.writer.reset();
  const std::string why = all_from(report.reader);
  const std::string told = all_from(number.reader);
  waitpid(starter, nullptr, 0);
  pid_t child = -1;
  if (told.size() == sizeof child) std::memcpy(&child, told.data(), sizeof child);
  if (why.empty() && child > 0) return child;
  if (child > 0) waitpid(child, nullptr, 0);
  throw std::runtime_error(fmt::format("cannot start {}: {}", launch.program, why));
}

void raise_descriptor_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit_before = limit;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
}

std::vector<std::string> merged(const std::vector<std::string>& environment,
                                const std::vector<std::string>& more) {
  std::vector<std::string> all;
  const auto put = [&all](const std::string& variable) {
    const auto is_same = [&](const std::string& other) {
      return name_of(other) == name_of(variable);
    };
    const auto found = std::ranges::find_if(all, is_same);
    if (found != all.end()) {
      *found = variable;
    } else {
      all.push_back(variable);
    }
  };
  std::ranges::for_each(environment, put);
  std::ranges::for_each(more, put);
  return all;
}

std::vector<std::string> inside(const std::vector<std::string>& environment,
                                const std::string& library, const std::string& dilation) {
  std::string preloaded = library;
  for (const std::string& variable : environment) {
    const std::string value = variable.substr(std::min(variable.find('=') + 1, variable.size()));
    if (name_of(variable) == "LD_PRELOAD" && !value.empty())
      preloaded = fmt::format("{}:{}", library, value);
  }
  return merged(environment, {"LD_PRELOAD=" + preloaded, "BARAKA_DILATION=" + dilation,
                              fmt::format("{}={}", kRoomVariable, kRoomFile)});
}

}  // namespace programs::netns
