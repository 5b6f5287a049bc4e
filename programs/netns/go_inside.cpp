#include "programs/netns/go_inside.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <grp.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "programs/netns/launch.h"
#include "programs/netns/loadable.h"
#include "programs/netns/namespaces.h"
#include "programs/netns/run_state.h"
#include "programs/netns/shown.h"
#include "programs/netns/spaces.h"
#include "programs/netns/terminal.h"

namespace programs::netns {
namespace {

struct Doors {
  FileDescriptor users, mounts;
  AgentSpaces agent;
};

Doors doors_of(const RunState& run, const RunState::Agent& agent) {
  const auto opened = [&run](const std::string& path) {
    return open_file(fmt::format("/proc/{}/{}", run.init.number, path), O_RDONLY | O_NONBLOCK);
  };
  const auto held = [&opened](int descriptor) { return opened(fmt::format("fd/{}", descriptor)); };
  return {opened("ns/user"),
          opened("ns/mnt"),
          {held(agent.users), held(agent.processes), held(agent.network), held(agent.mount),
           held(agent.host), held(agent.ipc)}};
}

const RunState::Agent& agent_of(const RunState& run, const std::string& name) {
  const auto found = std::ranges::find(run.agents, name, &RunState::Agent::name);
  if (found != run.agents.end()) return *found;
  std::vector<std::string> names;
  for (const RunState::Agent& agent : run.agents) names.push_back(agent.name);
  throw std::runtime_error(
      fmt::format("no agent '{}' with a network: there are {}", name, fmt::join(names, ", ")));
}

/// Called before anything that the run's user can influence is opened, loaded or started.
void become_user_of(const RunState& run) {
  if (run.user == geteuid()) return;
  if (setgroups(0, nullptr) != 0 || setresgid(run.group, run.group, run.group) != 0 ||
      setresuid(run.user, run.user, run.user) != 0) {
    fail("the user of the run");
  }
}

double factor_of(const RunState& run) {
  double factor = 0;
  const char* const end = run.dilation.data() + run.dilation.size();
  if (std::from_chars(run.dilation.data(), end, factor).ec != std::errc{} || !(factor > 0)) {
    throw std::runtime_error(fmt::format("{}: '{}' is no dilation", kStateFile, run.dilation));
  }
  return factor;
}

/// Enters the agent through the run's namespaces, from which files to be shown can be taken along.
/// The process namespace changes only for children.
void pass(const Doors& doors, const Launch& launch) {
  if (setns(doors.users.get(), CLONE_NEWUSER) != 0) fail("the users of the run");
  if (setresgid(0, 0, 0) != 0 || setresuid(0, 0, 0) != 0) fail("user 0 of the run");
  if (setns(doors.mounts.get(), CLONE_NEWNS) != 0) fail("the mounts of the run");
  Shown shown;
  for (const std::string& one : launch.shown) shown.add(one);
  shown.add_folder_of(launch.program);
  enter(doors.agent);
  shown.put();
}

std::vector<std::string> own_environment() {
  std::vector<std::string> variables;
  for (char** one = environ; *one != nullptr; ++one) variables.emplace_back(*one);
  return variables;
}

std::string shell() {
  const char* const named = std::getenv("SHELL");
  return named != nullptr && *named != '\0' ? named : "/bin/sh";
}

Launch launch_of(const RunState& run, std::vector<std::string> command) {
  if (command.empty()) command = {shell()};
  const char* const path = std::getenv("PATH");
  const auto program = program_file(command[0], path == nullptr ? "/usr/bin:/bin" : path);
  require_preloaded(program, {.factor = factor_of(run)});
  const std::string folder = std::filesystem::current_path().string();
  return {program.string(),
          std::move(command),
          inside(own_environment(), run.library, run.dilation),
          folder,
          {folder, std::filesystem::path(run.library).parent_path().string()}};
}

/// @param parent  readable after the parent has ended.
[[noreturn]] void become_child(const Launch& launch, const Terminal& terminal,
                               const FileDescriptor& parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  pollfd polled{parent.get(), POLLIN, 0};
  if (poll(&polled, 1, 0) != 0) _exit(EXIT_FAILURE);  // the parent died before the line above
  terminal.take();
  // The folder may not exist inside, for example a folder of /dev/shm or /proc.
  if (chdir(launch.folder.c_str()) != 0 && chdir("/") != 0) _exit(126);
  for (const int one : {SIGINT, SIGQUIT, SIGTERM, SIGHUP}) signal(one, SIG_DFL);
  become(launch);
  std::fprintf(stderr, "error: cannot start %s\n", launch.program.c_str());
  _exit(126);
}

volatile std::sig_atomic_t child_to_tell = 0;

void tell_child(int what) {
  if (child_to_tell > 0) kill(static_cast<pid_t>(child_to_tell), what);
}

/// Signals of the terminal go to both processes; signals that others send to this one are passed
/// on.
void prepare_signals() {
  signal(SIGINT, SIG_IGN);
  signal(SIGQUIT, SIG_IGN);
  struct sigaction action {};
  action.sa_handler = tell_child;
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGHUP, &action, nullptr);
}

/// Waits for the child. When the terminal stops the child, this process stops as well, and
/// continues with it.
int status_of_end(pid_t child, const Terminal& terminal) {
  for (int status = 0;;) {
    if (waitpid(child, &status, WUNTRACED) < 0) {
      if (errno == EINTR) continue;
      fail("a program inside the agent");
    }
    if (!WIFSTOPPED(status)) return status;
    terminal.take_back();
    raise(SIGSTOP);
    terminal.give_to(child);
    kill(-child, SIGCONT);
    kill(child, SIGCONT);
  }
}

}  // namespace

int go_inside(const std::filesystem::path& folder, const std::string& agent,
              const std::vector<std::string>& command) {
  const RunState run = RunState::read(folder);
  become_user_of(run);
  const Launch launch = launch_of(run, command);
  {
    // The descriptors are closed again before there is a process that others inside can see.
    const Doors doors = doors_of(run, agent_of(run, agent));
    if (!run.init.is_alive()) throw std::runtime_error("the run has just ended");
    pass(doors, launch);
  }
  prepare_signals();
  const Terminal terminal;
  std::array<int, 2> lifeline{};
  if (pipe2(lifeline.data(), O_CLOEXEC) != 0) fail("a pipe");
  const FileDescriptor reader(lifeline[0]);
  FileDescriptor writer(lifeline[1]);
  const pid_t child = fork();
  if (child < 0) fail("a process of the run");  // the run has just ended
  if (child == 0) {
    writer.reset();
    become_child(launch, terminal, reader);
  }
  child_to_tell = child;
  terminal.give_to(child);
  const int status = status_of_end(child, terminal);
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  return 128 + WTERMSIG(status);
}

}  // namespace programs::netns
