#include "programs/netns/spaces.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <cstring>
#include <optional>
#include <utility>

#include "programs/netns/first_of_agent.h"
#include "programs/netns/icmp.h"
#include "programs/netns/interface.h"
#include "programs/netns/kernel_timers.h"
#include "programs/netns/neighbours.h"
#include "programs/netns/pipe.h"
#include "programs/netns/routes.h"
#include "programs/netns/user_ids.h"

namespace programs::netns {
namespace {

/// A number from a file of the kernel; nullopt if there is no such file.
std::optional<std::int64_t> kernel_number(const char* path) {
  const FileDescriptor file(open(path, O_RDONLY | O_CLOEXEC));
  std::array<char, 32> text{};
  const ssize_t length = file.is_open() ? read(file.get(), text.data(), text.size()) : -1;
  std::int64_t value = 0;
  if (length <= 0 || std::from_chars(text.data(), text.data() + length, value).ec != std::errc{}) {
    return std::nullopt;
  }
  return value;
}

/// Reports why user namespaces are refused, and how to allow them.
[[noreturn]] void fail_of_users(int error) {
  constexpr std::string_view kWhat = "agents with a network need user namespaces";
  if (kernel_number("/proc/sys/user/max_user_namespaces") == 0) {
    throw std::runtime_error(
        fmt::format("{}, of which none are allowed here; allow them with 'sysctl "
                    "user.max_user_namespaces=10000'",
                    kWhat));
  }
  if (kernel_number("/proc/sys/kernel/unprivileged_userns_clone") == 0) {
    throw std::runtime_error(
        fmt::format("{}, which only root may make here; allow them with 'sysctl "
                    "kernel.unprivileged_userns_clone=1'",
                    kWhat));
  }
  if (kernel_number("/proc/sys/kernel/apparmor_restrict_unprivileged_userns") == 1) {
    throw std::runtime_error(
        fmt::format("{}, which AppArmor withholds here; allow them with 'sysctl "
                    "kernel.apparmor_restrict_unprivileged_userns=0'",
                    kWhat));
  }
  fail(fmt::format("{}, which are refused: in a container, give it '--security-opt "
                   "seccomp=unconfined --security-opt apparmor=unconfined'",
                   kWhat),
       error);
}

/// Makes the page. Programs write to it, but none may truncate it, because a process that has it
/// mapped, as the run has, would be killed by that. Only anonymous memory can be sealed against it;
/// programs find it by a link to a descriptor of the agent's first process.
FileDescriptor make_page() {
  constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;
  FileDescriptor page(memfd_create("baraka-room", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!page.is_open() || fchmod(page.get(), 0666) != 0 ||
      ftruncate(page.get(), kRoomFileSize) != 0 || fcntl(page.get(), F_ADD_SEALS, kSeals) != 0) {
    fail(kRoomFile);
  }
  return page;
}

/// Makes the interfaces and the page. Called by a process in the run's network; it joins the
/// agent's meanwhile.
AgentEnds make_ends(const AgentNetwork& network, const AgentSpaces& spaces,
                    const RunOfAgents& run) {
  constexpr gid_t kMostOfKernel = 0x7fff'ffff;
  const FileDescriptor own = own_namespace("net");
  join(spaces.network, "network");
  AgentEnds ends;
  ends.tap = make_interfaces(network);
  keep_places(network, run.agents);
  set_routes(network);
  if (run.time.is_held) {
    hold_kernel_timers();
    unbound_icmp_errors();
  } else {
    stretch_kernel_timers(run.time.factor);
    bound_icmp_errors(run.agents.size());
  }
  write_file("/proc/sys/net/ipv4/ping_group_range",
             fmt::format("0 {}", std::min(last_group(), kMostOfKernel)));
  ends.counters = open_file("/proc/self/net/dev", O_RDONLY);
  ends.tcp = open_file("/proc/self/net/tcp", O_RDONLY);
  ends.tcp6 = FileDescriptor(open("/proc/self/net/tcp6", O_RDONLY | O_CLOEXEC));
  if (!ends.tcp6.is_open()) ends.tcp6 = open_file("/proc/self/net/tcp", O_RDONLY);
  ends.page = make_page();
  join(own, "way back out of its network");
  return ends;
}

/// Runs in a child: makes the namespaces and keeps them until the parent has opened them.
[[noreturn]] void keep_new_spaces(const AgentNetwork& network, FileDescriptor& report) {
  std::string why;
  if (unshare(CLONE_NEWUSER | CLONE_NEWNET | CLONE_NEWUTS | CLONE_NEWIPC) != 0) {
    why = std::string("the namespaces of an agent: ") + std::strerror(errno);
  } else if (sethostname(network.agent.data(), network.agent.size()) != 0) {
    why = "its name as a host's: " + std::string(std::strerror(errno));
  }
  (void)!write(report.get(), why.data(), why.size());
  report.reset();
  for (;;) pause();
}

void map_users_of(pid_t process) {
  const std::string folder = fmt::format("/proc/{}/", process);
  write_file(folder + "uid_map", identity_map("/proc/self/uid_map"));
  write_file(folder + "gid_map", identity_map("/proc/self/gid_map"));
}

/// A process that keeps the namespaces of an agent, except those of mounts and processes.
struct Keeper {
  explicit Keeper(const AgentNetwork& network) {
    Pipe report;
    process = fork();
    if (process < 0) fail("the namespaces of an agent");
    if (process == 0) keep_new_spaces(network, report.writer);
    reader = std::move(report.reader);
  }
  ~Keeper() {
    if (process < 0) return;
    kill(process, SIGKILL);
    while (waitpid(process, nullptr, 0) < 0 && errno == EINTR) continue;
  }
  Keeper(Keeper&& other) noexcept
      : process(std::exchange(other.process, -1)), reader(std::move(other.reader)) {}
  Keeper& operator=(Keeper&&) = delete;
  Keeper(const Keeper&) = delete;
  Keeper& operator=(const Keeper&) = delete;

  /// Opens the namespaces, and maps the users of the run into that of users.
  AgentSpaces take(const AgentNetwork& network) const {
    const std::string why = all_from(reader);
    if (!why.empty()) throw std::runtime_error(fmt::format("agent {}: {}", network.agent, why));
    const auto opened = [this](const char* name) {
      return open_file(fmt::format("/proc/{}/ns/{}", process, name), O_RDONLY);
    };
    AgentSpaces spaces;
    spaces.users = opened("user");
    spaces.network = opened("net");
    spaces.host = opened("uts");
    spaces.ipc = opened("ipc");
    map_users_of(process);
    return spaces;
  }

  pid_t process = -1;
  FileDescriptor reader;
};

}  // namespace

void unshare_or_fail(int what) {
  if (unshare(what) != 0) {
    fail(
        "the namespaces of a network, of mounts and of processes are refused here (see 'sysctl -a "
        "-r user.max_')");
  }
}

FileDescriptor own_namespace(const char* name) {
  return open_file(fmt::format("/proc/self/ns/{}", name), O_RDONLY);
}

void join(const FileDescriptor& space, const char* what) {
  if (setns(space.get(), 0) != 0) fail(fmt::format("the agent's {}", what));
}

std::string enter_new_run() {
  IdMapper mapper;
  if (unshare(CLONE_NEWUSER) != 0) fail_of_users(errno);
  std::string why_alone;
  try {
    why_alone = mapper.map();
  } catch (const std::runtime_error&) {
    fail_of_users(errno);
  }
  // AppArmor can allow making user namespaces and then forbid all use of them.
  if (unshare(CLONE_NEWNS) != 0) fail_of_users(errno);
  unshare_or_fail(CLONE_NEWNET | CLONE_NEWPID | CLONE_NEWUTS | CLONE_NEWIPC);
  if (mount(nullptr, "/", nullptr, MS_REC | MS_SLAVE, nullptr) != 0) fail("mounts of the run");
  return why_alone;
}

std::vector<AgentMade> make_agents(const RunOfAgents& run) {
  std::vector<Keeper> keepers;
  std::vector<AgentMade> all;
  std::vector<FileDescriptor> reports;
  keepers.reserve(run.agents.size());
  all.reserve(run.agents.size());
  reports.reserve(run.agents.size());
  for (const AgentNetwork& network : run.agents) keepers.emplace_back(network);
  for (std::size_t i = 0; i < run.agents.size(); ++i) {
    AgentMade& made = all.emplace_back();
    made.spaces = keepers[i].take(run.agents[i]);
    made.ends = make_ends(run.agents[i], made.spaces, run);
    reports.push_back(start_first_of_agent(run.agents[i], run, made));
  }
  for (std::size_t i = 0; i < all.size(); ++i) await_first_of_agent(reports[i], all[i]);
  return all;
}

std::uint64_t icmp_not_sent_by(const AgentSpaces& spaces) {
  const FileDescriptor own = own_namespace("net");
  join(spaces.network, "network");
  const std::uint64_t count = icmp_not_sent();
  join(own, "way back out of its network");
  return count;
}

void enter(const AgentSpaces& spaces) {
  join(spaces.processes, "processes");
  join(spaces.network, "network");
  join(spaces.ipc, "IPC");
  join(spaces.host, "host name");
  join(spaces.users, "users");
  join(spaces.mount, "mounts");
}

}  // namespace programs::netns
