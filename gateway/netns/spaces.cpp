#include "gateway/netns/spaces.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/stat.h>

#include <array>
#include <charconv>
#include <limits>
#include <optional>

#include "gateway/netns/addresses.h"
#include "gateway/netns/interface.h"
#include "gateway/netns/kernel_timers.h"
#include "gateway/netns/neighbours.h"

namespace gateway::netns {
namespace {

void write_file(const std::string& path, const std::string& content, int flags = 0) {
  const FileDescriptor file = open_file(path, O_WRONLY | flags, 0644);
  if (write(file.get(), content.data(), content.size()) < 0) fail(path);
}

/// A number that the kernel tells; nothing where it has no such file.
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

/// Why user namespaces are refused, and what allows them.
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

void unshare_or_fail(int what) {
  if (unshare(what) != 0) {
    fail(
        "the namespaces of a network, of mounts and of processes are refused here (see 'sysctl -a "
        "-r user.max_')");
  }
}

void mount_or_fail(const char* type, const char* where, unsigned long flags,
                   const char* options = nullptr) {
  if (mount(type, where, type, flags, options) != 0) {
    fail(
        fmt::format("{} of the run cannot be mounted; a container whose /proc is masked needs "
                    "'--security-opt systempaths=unconfined'",
                    where));
  }
}

FileDescriptor own_namespace(const char* name) {
  return open_file(fmt::format("/proc/self/ns/{}", name), O_RDONLY);
}

AgentSpaces own_spaces() {
  return {own_namespace("net"), own_namespace("mnt"), own_namespace("uts"), own_namespace("ipc")};
}

/// One file in place of another.
void cover(const char* file, const std::string& content) {
  constexpr const char* kTemporary = "/dev/shm/.baraka-covering";
  write_file(kTemporary, content, O_CREAT | O_TRUNC);
  if (mount(kTemporary, file, nullptr, MS_BIND, nullptr) != 0) fail(file);
  unlink(kTemporary);
}

std::string hosts(const std::vector<AgentNetwork>& all) {
  std::string text =
      "127.0.0.1 localhost\n::1 localhost ip6-localhost ip6-loopback\nff02::1 ip6-allnodes\n";
  for (const AgentNetwork& one : all) {
    text += fmt::format("{} {}\n{} {}\n", to_text(one.address), one.agent,
                        to_text(unique_local_address(one.id)), one.agent);
  }
  return text;
}

/// Programs write to it, but none may cut it off: whoever has it mapped would die of that, and the
/// run has. Only memory without a name can be sealed so; the name leads to it by way of init.
FileDescriptor make_page() {
  constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;
  FileDescriptor page(memfd_create("baraka-room", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!page.is_open() || fchmod(page.get(), 0666) != 0 ||
      ftruncate(page.get(), sizeof(RoomPage)) != 0 || fcntl(page.get(), F_ADD_SEALS, kSeals) != 0 ||
      symlink(fmt::format("/proc/1/fd/{}", page.get()).c_str(), kRoomFile) != 0) {
    fail(kRoomFile);
  }
  return page;
}

void make_files(const AgentNetwork& network, const std::vector<AgentNetwork>& all) {
  mount_or_fail("tmpfs", "/dev/shm", MS_NOSUID | MS_NODEV, "mode=1777");
  cover("/etc/hosts", hosts(all));
  // IPv4 first, where programs leave it to the C library: it is what the scenario names.
  if (access("/etc/gai.conf", F_OK) == 0) {
    cover("/etc/gai.conf", "precedence ::ffff:0:0/96 100\n");
  }
  if (sethostname(network.agent.data(), network.agent.size()) != 0) {
    fail(fmt::format("agent {}: its name as a host's", network.agent));
  }
  // Best: /sys/class/net with the agent's interfaces. No program needs it to send.
  mount("sysfs", "/sys", "sysfs", MS_NOSUID | MS_NODEV | MS_NOEXEC | MS_RDONLY, nullptr);
}

AgentEnds make_ends(const AgentNetwork& network, const std::vector<AgentNetwork>& all,
                    double factor) {
  unshare_or_fail(CLONE_NEWNET | CLONE_NEWNS | CLONE_NEWUTS | CLONE_NEWIPC);
  make_files(network, all);
  AgentEnds ends;
  ends.tap = make_interfaces(network);
  keep_places(network, all);
  stretch_kernel_timers(factor);
  write_file("/proc/sys/net/ipv4/ping_group_range", "0 0");
  ends.counters = open_file("/proc/self/net/dev", O_RDONLY);
  ends.page = make_page();
  return ends;
}

void join(const FileDescriptor& space, const char* what) {
  if (setns(space.get(), 0) != 0) fail(fmt::format("the agent's {}", what));
}

}  // namespace

void enter_new_run() {
  const std::string user = fmt::format("0 {} 1", geteuid());
  const std::string group = fmt::format("0 {} 1", getegid());
  if (unshare(CLONE_NEWUSER) != 0) fail_of_users(errno);
  try {
    write_file("/proc/self/setgroups", "deny");
    write_file("/proc/self/uid_map", user);
    write_file("/proc/self/gid_map", group);
  } catch (const std::runtime_error&) {
    fail_of_users(errno);
  }
  // AppArmor lets one make them and then forbids all use.
  if (unshare(CLONE_NEWNS) != 0) fail_of_users(errno);
  unshare_or_fail(CLONE_NEWNET | CLONE_NEWPID | CLONE_NEWUTS | CLONE_NEWIPC);
  if (mount(nullptr, "/", nullptr, MS_REC | MS_SLAVE, nullptr) != 0) fail("mounts of the run");
}

void mount_proc() { mount_or_fail("proc", "/proc", MS_NOSUID | MS_NODEV | MS_NOEXEC); }

AgentMade make_agent(const AgentNetwork& network, const std::vector<AgentNetwork>& all,
                     double factor) {
  const AgentSpaces own = own_spaces();
  AgentMade made;
  made.ends = make_ends(network, all, factor);
  made.spaces = own_spaces();
  enter(own);
  return made;
}

void enter(const AgentSpaces& spaces) {
  join(spaces.network, "network");
  join(spaces.ipc, "IPC");
  join(spaces.host, "host name");
  join(spaces.mount, "mounts");
}

}  // namespace gateway::netns
