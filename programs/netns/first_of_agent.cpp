#include "programs/netns/first_of_agent.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <utility>

#include "programs/netns/agent_root.h"
#include "programs/netns/pipe.h"

namespace programs::netns {
namespace {

/// Descriptors of the agent's first process. In the run's first process, its parent, these numbers
/// are the sockets to baraka.
constexpr int kReport = STDERR_FILENO + 1, kPage = kReport + 1;

void place(int descriptor, int where) {
  if (dup3(descriptor, where, O_CLOEXEC) < 0) fail("a descriptor of an agent");
}

/// Enters the agent's namespaces. Mounts made before it joins the agent's users are locked by that.
void go_into(const AgentNetwork& network, const AgentMade& made, const RunOfAgents& run) {
  unshare_or_fail(CLONE_NEWNS);
  join(made.spaces.network, "network");
  mount_agent_root(network, run.agents, run.shown);
  if (symlink(fmt::format("/proc/1/fd/{}", kPage).c_str(), kRoomFile) != 0) fail(kRoomFile);
  join(made.spaces.users, "users");
  unshare_or_fail(CLONE_NEWNS);
  join(made.spaces.host, "host name");
  join(made.spaces.ipc, "IPC");
  if (chdir("/") != 0) fail("/");
}

[[noreturn]] void reap_for_ever() {
  sigset_t children;
  sigemptyset(&children);
  sigaddset(&children, SIGCHLD);
  for (;;) {
    sigwaitinfo(&children, nullptr);
    while (waitpid(-1, nullptr, WNOHANG) > 0) continue;
  }
}

[[noreturn]] void be_first(const AgentNetwork& network, const AgentMade& made,
                           const RunOfAgents& run, const Pipe& report) {
  prctl(PR_SET_NAME, "baraka-agent");
  std::string why;
  try {
    const FileDescriptor page(fcntl(made.ends.page.get(), F_DUPFD_CLOEXEC, kPage + 1));
    place(report.writer.get(), kReport);
    place(page.get(), kPage);
    go_into(network, made, run);
  } catch (const std::exception& error) {
    why = fmt::format("agent {}: {}", network.agent, error.what());
  }
  (void)!write(kReport, why.data(), why.size());
  if (!why.empty()) _exit(EXIT_FAILURE);
  // Standard error of baraka goes to a file or terminal that does not belong to this agent, so it
  // is replaced.
  if (dup2(STDIN_FILENO, STDERR_FILENO) < 0) _exit(EXIT_FAILURE);
  close_range(kPage + 1, ~0U, 0);
  close(kReport);
  reap_for_ever();
}

}  // namespace

FileDescriptor start_first_of_agent(const AgentNetwork& network, const RunOfAgents& run,
                                    AgentMade& made) {
  Pipe report;
  const FileDescriptor own = own_namespace("pid");
  unshare_or_fail(CLONE_NEWPID);
  made.init = fork();
  const int error = errno;
  if (made.init == 0) be_first(network, made, run, report);
  join(own, "way back out of its processes");
  if (made.init < 0) fail("the first process of an agent", error);
  return std::move(report.reader);
}

void await_first_of_agent(const FileDescriptor& report, AgentMade& made) {
  const std::string why = all_from(report);
  if (!why.empty()) throw std::runtime_error(why);
  const std::string spaces = fmt::format("/proc/{}/ns/", made.init);
  made.spaces.mount = open_file(spaces + "mnt", O_RDONLY);
  made.spaces.processes = open_file(spaces + "pid", O_RDONLY);
}

}  // namespace programs::netns
