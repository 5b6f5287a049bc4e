#include "hal/dds/speaker_check.h"

#include <arpa/inet.h>
#include <dirent.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace hal::dds {
namespace {

/// UID_MIN of login.defs(5): below are root and the users of services.
constexpr uid_t kFirstPerson = 1000;

bool is_there(std::int64_t pid) {
  return pid > 0 && (kill(static_cast<pid_t>(pid), 0) == 0 || errno == EPERM);
}

/// Whether a process has a socket open; nothing if this one may not know.
std::optional<bool> has_socket(std::int64_t pid, const std::string& inode) {
  const std::string wanted = "socket:[" + inode + "]";
  std::error_code error;
  const std::filesystem::directory_iterator files(fmt::format("/proc/{}/fd", pid), error);
  if (error) return std::nullopt;
  for (const auto& file : files) {
    const auto target = std::filesystem::read_symlink(file.path(), error);
    if (!error && target == wanted) return true;
  }
  return false;
}

/// Whose a process is; nothing if this one may not know.
std::optional<uid_t> user_of(std::int64_t pid) {
  std::ifstream status(fmt::format("/proc/{}/status", pid));
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with("Uid:")) continue;
    std::istringstream fields(line.substr(4));
    uid_t real = 0, effective = 0;
    if (fields >> real >> effective) return effective;
  }
  return std::nullopt;
}

bool is_of_this_host(const ProcessIdentity& claimed) { return claimed.host == this_process().host; }

/// As socket_at(), in one look.
std::optional<std::string> look_for_socket_at(const UdpSender& sender) {
  // The address is in the order of the network, read as a number of this machine; or any.
  const std::string one = fmt::format("{:08X}:{:04X}", htonl(sender.address), sender.port);
  const std::string any = fmt::format("{:08X}:{:04X}", 0, sender.port);
  std::ifstream sockets("/proc/net/udp");
  if (!sockets) return std::nullopt;
  std::string line;
  std::getline(sockets, line);
  while (std::getline(sockets, line)) {
    std::istringstream fields(line);
    std::string number, local, skipped, inode;
    fields >> number >> local;
    if (local != one && local != any) continue;
    for (int field = 2; field < 9; ++field) fields >> skipped;
    fields >> inode;
    return inode;
  }
  return std::string();
}

}  // namespace

/// The kernel's table is not read at one instant: while other sockets come and go, one
/// that is there all along may be passed over.
std::optional<std::string> socket_at(const UdpSender& sender) {
  constexpr int kLooks = 3;
  std::optional<std::string> found;
  for (int look = 0; look < kLooks; ++look) {
    found = look_for_socket_at(sender);
    if (!found || !found->empty()) break;
  }
  return found;
}

Result<void> check_speaker(const ProcessIdentity& claimed, const std::optional<UdpSender>& sender) {
  if (!is_of_this_host(claimed)) return {};
  const auto refuse = [&](const std::string& what) -> Result<void> {
    return fail(Errc::kProtocol, fmt::format("pid {} {}", claimed.pid, what));
  };
  if (!is_there(claimed.pid)) return refuse("does not run");
  const auto start_time = start_time_of(claimed.pid);
  if (start_time && *start_time != claimed.start_time) return refuse("has started at another time");
  if (!sender) return {};
  const std::optional<std::string> socket = socket_at(*sender);
  if (!socket) return {};
  if (socket->empty() || has_socket(claimed.pid, *socket) == false) {
    return refuse(fmt::format("has not the port {} that it speaks from", sender->text()));
  }
  return {};
}

Result<void> check_user(const ProcessIdentity& claimed) {
  if (!is_of_this_host(claimed)) return {};
  const std::optional<uid_t> user = user_of(claimed.pid);
  const uid_t own = geteuid();
  if (!user || *user == own || *user < kFirstPerson || own < kFirstPerson) return {};
  return fail(Errc::kProtocol,
              fmt::format("pid {} is of user {}, this is user {}", claimed.pid, *user, own));
}

}  // namespace hal::dds
