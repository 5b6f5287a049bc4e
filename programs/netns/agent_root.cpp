#include "programs/netns/agent_root.h"

#include <fmt/format.h>
#include <sys/mount.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "programs/netns/addresses.h"
#include "programs/netns/shown.h"
#include "programs/netns/user_ids.h"

namespace programs::netns {
namespace {

constexpr unsigned long kPlain = MS_NOSUID | MS_NODEV | MS_NOEXEC;

void mount_or_fail(const char* type, const char* where, unsigned long flags,
                   const char* options = nullptr) {
  if (mount(type, where, type, flags, options) != 0) {
    fail(
        fmt::format("{} of the run cannot be mounted; a container whose /proc is masked needs "
                    "'--security-opt systempaths=unconfined'",
                    where));
  }
}

/// Covers a file by another one.
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

/// A folder of the host's /run, which is made without content: daemons expect /run/lock and their
/// own.
struct EmptyFolder {
  std::filesystem::path path;
  struct stat status;
};

std::vector<EmptyFolder> folders_of_run() {
  std::vector<EmptyFolder> folders;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/run", error)) {
    struct stat status {};
    if (lstat(entry.path().c_str(), &status) != 0 || !S_ISDIR(status.st_mode)) continue;
    folders.push_back({entry.path(), status});
  }
  return folders;
}

/// Makes the folders. Those of users that do not exist inside belong to user 0.
void make_again(const std::vector<EmptyFolder>& folders) {
  constexpr uid_t kUnknown = 65534;  // /proc/sys/kernel/overflowuid
  for (const auto& [path, status] : folders) {
    if (mkdir(path.c_str(), 0755) != 0 || chmod(path.c_str(), status.st_mode & 07777) != 0)
      continue;
    if (status.st_uid != kUnknown) (void)!chown(path.c_str(), status.st_uid, status.st_gid);
  }
}

void mount_own_folders() {
  const std::vector<EmptyFolder> folders = folders_of_run();
  for (const char* const folder : kOwnFolders) {
    if (!std::filesystem::is_directory(folder)) continue;
    const bool is_run = std::string_view(folder) == "/run";
    mount_or_fail("tmpfs", folder, MS_NOSUID | MS_NODEV,
                  is_run ? "mode=0755,size=256m" : "mode=1777,size=1g");
  }
  make_again(folders);
}

void bind(const std::string& path, const char* source, unsigned long flags) {
  if (mount(source, path.c_str(), nullptr, MS_BIND, nullptr) != 0 ||
      mount(nullptr, path.c_str(), nullptr, MS_BIND | MS_REMOUNT | MS_NOSUID | flags, nullptr) !=
          0) {
    fail(fmt::format("{} of an agent", path));
  }
}

bool is_writable(std::filesystem::perms rights) {
  using std::filesystem::perms;
  const perms writable = perms::owner_write | perms::group_write | perms::others_write;
  return (rights & writable) != perms::none;
}

bool is_of_process(const std::string& name) {
  return name.find_first_not_of("0123456789") == std::string::npos;
}

/// Protects /proc. Some of its files control the kernel as a whole, and the user of the run may
/// write them if that is root: everything that does not belong to a process becomes read-only, and
/// files with information about others become empty.
void lock_proc() {
  constexpr std::array<std::string_view, 3> kMasked{"kcore", "keys", "timer_list"};
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (is_of_process(name) || entry.is_symlink()) continue;
    if (std::ranges::find(kMasked, name) != kMasked.end()) {
      bind(entry.path(), "/dev/null", MS_NOEXEC);
    } else if (entry.is_directory() || is_writable(entry.symlink_status().permissions())) {
      bind(entry.path(), entry.path().c_str(), MS_NODEV | MS_NOEXEC | MS_RDONLY);
    }
  }
  // These belong to the network: routing daemons write them.
  constexpr const char* kOfNetwork = "/proc/sys/net";
  bind(kOfNetwork, kOfNetwork, MS_NODEV | MS_NOEXEC);
}

/// Lets process ids differ between agents: DDS derives its identities from them.
void begin_numbers_at(std::uint16_t id) {
  constexpr int kApart = 100, kBelow = 30'000;
  const FileDescriptor file(open("/proc/sys/kernel/ns_last_pid", O_WRONLY | O_CLOEXEC));
  const std::string last = std::to_string(id * kApart % kBelow);
  if (file.is_open()) (void)!write(file.get(), last.data(), last.size());
}

}  // namespace

void mount_proc() { mount_or_fail("proc", "/proc", kPlain); }

void mount_agent_root(const AgentNetwork& network, const std::vector<AgentNetwork>& all,
                      const std::vector<std::string>& shown) {
  Shown kept;
  for (const std::string& one : shown) kept.add(one);
  mount_own_folders();
  kept.put();
  cover("/etc/hosts", hosts(all));
  // IPv4 first, if programs leave the choice to the C library: the scenario names these addresses.
  if (access("/etc/gai.conf", F_OK) == 0) {
    cover("/etc/gai.conf", "precedence ::ffff:0:0/96 100\n");
  }
  // A new sysfs shows the agent's interfaces, but no program needs that to send.
  if (mount("sysfs", "/sys", "sysfs", kPlain | MS_RDONLY, nullptr) != 0) {
    bind("/sys", "/sys", MS_NODEV | MS_NOEXEC | MS_RDONLY);
  }
  mount_proc();
  begin_numbers_at(network.id);
  lock_proc();
}

}  // namespace programs::netns
