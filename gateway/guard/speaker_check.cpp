#include "gateway/guard/speaker_check.h"

#include <fmt/core.h>

#include <cerrno>
#include <csignal>
#include <optional>
#include <string>

#include "gateway/guard/socket_owner.h"
#include "gateway/guard/socket_table.h"

namespace gateway::guard {
namespace {

bool is_there(std::int64_t pid) {
  return pid > 0 && (kill(static_cast<pid_t>(pid), 0) == 0 || errno == EPERM);
}

bool is_of_this_host(const process::ProcessIdentity& claimed) {
  return claimed.host == process::this_process().host;
}

/// Inode of the only socket that a datagram can come from; 0: there is none; nullopt: it cannot be
/// determined.
std::optional<std::uint64_t> socket_of(const UdpSender& sender) {
  const auto sockets = sockets_behind(sender);
  if (!sockets || sockets->size() > 1) return std::nullopt;
  return sockets->empty() ? 0 : sockets->front().inode;
}

hal::Result<void> check_user(const process::ProcessIdentity& claimed,
                             const std::optional<UdpSender>& sender, const Trust& trust) {
  const auto refuse = [&](const std::string& why) -> hal::Result<void> {
    return hal::fail(hal::Errc::kProtocol, fmt::format("pid {} of host '{}' is not heard: {}",
                                                       claimed.pid, claimed.host, why));
  };
  if (!sender && trust.covers_unverified()) return {};
  if (!sender) return refuse("from where it speaks is not known");
  const SenderJudgement judgement = judge_sender(*sender, trust);
  if (!judgement.objection.empty()) return refuse(judgement.objection);
  return {};
}

}  // namespace

hal::Result<void> check_speaker(const process::ProcessIdentity& claimed,
                                const std::optional<UdpSender>& sender, const Trust* trust) {
  if (trust != nullptr) {
    if (auto user = check_user(claimed, sender, *trust); !user) return user;
  }
  if (!is_of_this_host(claimed)) return {};
  const auto refuse = [&](const std::string& what) -> hal::Result<void> {
    return hal::fail(hal::Errc::kProtocol, fmt::format("pid {} {}", claimed.pid, what));
  };
  if (!is_there(claimed.pid)) return refuse("does not run");
  const auto start_time = process::start_time_of(claimed.pid);
  if (start_time && *start_time != claimed.start_time) return refuse("has started at another time");
  if (!sender) return {};
  const std::optional<std::uint64_t> socket = socket_of(*sender);
  if (!socket) return {};
  if (*socket == 0 || has_socket(claimed.pid, *socket) == false) {
    return refuse(fmt::format("has not the port {} that it speaks from", sender->text()));
  }
  return {};
}

}  // namespace gateway::guard
