#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/guard/udp_sender.h"
#include "gateway/process/exit_status.h"

namespace gateway::guard {

/// The environment variable with the names of further trusted users.
inline constexpr const char* kTrustVariable = "BARAKA_TRUST";

/// BARAKA_TRUST names a user that does not exist on this computer.
struct NoSuchUser : process::UsageError {
  using UsageError::UsageError;
};

/// The users whose data a process accepts in the exchange: its own user, root, and the users that
/// are named. Other users, including services, are refused; a process of root refuses ordinary
/// users, too.
class Trust {
 public:
  /// Trusts the own user and root.
  Trust() = default;
  /// @param text  users, by name or number, separated by commas or blanks. `unverified` accepts
  /// also senders whose user cannot be determined, as in containers that share the network but have
  /// their own users; anybody can become such a sender.
  /// @throws NoSuchUser  a user does not exist.
  explicit Trust(std::string_view text);
  /// As BARAKA_TRUST says. @throws NoSuchUser  a user does not exist.
  static Trust of_environment();

  bool covers(uid_t user) const;
  bool covers_unverified() const { return covers_unverified_; }

 private:
  std::vector<uid_t> users_;
  bool covers_unverified_ = false;
};

/// Whether a user id reported by the kernel is the id of that user in this user namespace, and not
/// the one that stands for all users without an id here (user_namespaces(7), unmapped user IDs).
/// @param overflow  /proc/sys/kernel/overflowuid.   @param map  /proc/self/uid_map.
bool is_told(uid_t user, uid_t overflow, std::string_view map);
bool is_told(uid_t user);  ///< For this process.

/// The sender of a datagram, and whether to accept it.
struct SenderJudgement {
  std::optional<uid_t> user;  ///< None: unknown.
  std::uint64_t inode = 0;    ///< Inode of the socket; 0: not known.
  std::string objection;      ///< Empty: accepted; else "user 1002 has the port …".
};

/// Decides by the owner of the sender's port, not by what the sender claims.
SenderJudgement judge_sender(const UdpSender& sender, const Trust& trust);

}  // namespace gateway::guard
