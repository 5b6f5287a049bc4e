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

/// The environment variable that names further trusted users.
inline constexpr const char* kTrustVariable = "BARAKA_TRUST";

/// BARAKA_TRUST names a user that this computer does not have.
struct NoSuchUser : process::UsageError {
  using UsageError::UsageError;
};

/// The users whose data a process accepts in the exchange: its own user, root, and those that are
/// named. Other users, services included, are refused; a process of root refuses persons, too.
class Trust {
 public:
  /// Its own user and root.
  Trust() = default;
  /// @param text  users, by name or number, with commas or blanks between; `unverified`: also those
  ///   of whom it cannot be told which user they are, as in containers that share the network and
  ///   have users of their own. Whoever wants to can be one of these.
  /// @throws NoSuchUser
  explicit Trust(std::string_view text);
  /// As BARAKA_TRUST says.
  /// @throws NoSuchUser
  static Trust of_environment();

  bool covers(uid_t user) const;
  bool covers_unverified() const { return covers_unverified_; }

 private:
  std::vector<uid_t> users_;
  bool covers_unverified_ = false;
};

/// Whether a number that the kernel tells of a user is that user's in this user namespace, and not
/// the one that stands for all who have none (user_namespaces(7), unmapped user IDs).
/// @param overflow  /proc/sys/kernel/overflowuid.   @param map  /proc/self/uid_map.
bool is_told(uid_t user, uid_t overflow, std::string_view map);
bool is_told(uid_t user);  ///< In this process.

/// The sender of a datagram, and whether to accept it.
struct SenderJudgement {
  std::optional<uid_t> user;  ///< None: unknown.
  std::uint64_t inode = 0;    ///< Of the socket; 0: not known.
  std::string objection;      ///< Empty: accepted; else "user 1002 has the port …".
};

/// Decides by the socket that has the sender's port, and not by what the sender claims.
SenderJudgement judge_sender(const UdpSender& sender, const Trust& trust);

}  // namespace gateway::guard
