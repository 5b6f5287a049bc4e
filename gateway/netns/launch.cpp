#include "gateway/netns/launch.h"

#include <fmt/format.h>
#include <linux/close_range.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <optional>

namespace gateway::netns {
namespace {

constexpr int kFirstInherited = STDERR_FILENO + 1;

std::optional<rlimit> limit_before;  // raise_descriptor_limit()

/// Where nothing that is moved to its place overwrites what is still to be moved.
int moved_up(int descriptor, std::size_t count) {
  const int above = kFirstInherited + static_cast<int>(count);
  const int moved = fcntl(descriptor, F_DUPFD_CLOEXEC, above);
  if (moved < 0) fail("a descriptor of the program");
  return moved;
}

void take_descriptors(int log, const std::vector<int>& inherited, int& report) {
  report = moved_up(report, inherited.size());
  std::vector<int> moved;
  moved.reserve(inherited.size());
  for (const int one : inherited) moved.push_back(moved_up(one, inherited.size()));
  const int input = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (dup2(input, STDIN_FILENO) < 0 || dup2(log, STDOUT_FILENO) < 0 ||
      dup2(log, STDERR_FILENO) < 0) {
    fail("input and output of the program");
  }
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (dup2(moved[i], kFirstInherited + static_cast<int>(i)) < 0) fail("a descriptor");
  }
  const auto rest = static_cast<unsigned>(kFirstInherited) + static_cast<unsigned>(moved.size());
  close_range(rest, ~0U, CLOSE_RANGE_CLOEXEC);
}

/// In the child; writes to `report` why the program cannot be started.
[[noreturn]] void become_in(const Launch& launch, const AgentSpaces& spaces, int log,
                            const std::vector<int>& inherited, int report) {
  std::string why;
  try {
    setsid();
    enter(spaces);
    take_descriptors(log, inherited, report);
    if (chdir(launch.folder.c_str()) != 0) fail(launch.folder);
    become(launch);
    fail(launch.program);
  } catch (const std::exception& error) {
    why = error.what();
  }
  [[maybe_unused]] const ssize_t written = write(report, why.data(), why.size());
  _exit(127);
}

/// Until exec has closed its end.
std::string report_of(int descriptor) {
  std::string why;
  std::array<char, 512> part{};
  ssize_t length = 0;
  while ((length = read(descriptor, part.data(), part.size())) != 0) {
    if (length > 0) why.append(part.data(), static_cast<std::size_t>(length));
    if (length < 0 && errno != EINTR) break;
  }
  return why;
}

std::string_view name_of(std::string_view variable) {
  return variable.substr(0, variable.find('='));
}

/// By its environment: see inside(). No factor is above 1.
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
  // Who gets another user or more rights with a program's file does not load the library: ld.so(8).
  if (is_slowed(launch.environment)) prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  execve(launch.program.c_str(), pointers_to(launch.arguments).data(),
         pointers_to(launch.environment).data());
}

pid_t launch(const Launch& launch, const AgentSpaces& spaces, int log,
             const std::vector<int>& inherited) {
  std::array<int, 2> report{};
  if (pipe2(report.data(), O_CLOEXEC) != 0) fail(launch.program);
  const FileDescriptor reader(report[0]);
  FileDescriptor writer(report[1]);
  const pid_t child = fork();
  if (child < 0) fail(launch.program);
  if (child == 0) become_in(launch, spaces, log, inherited, writer.get());
  writer.reset();
  const std::string why = report_of(reader.get());
  if (why.empty()) return child;
  waitpid(child, nullptr, 0);
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

}  // namespace gateway::netns
