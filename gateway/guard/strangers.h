#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gateway/guard/trust.h"
#include "gateway/guard/udp_sender.h"
#include "hal/rtps/cursor.h"
#include "hal/types/clock.h"
#include "hal/types/time.h"

namespace gateway::guard {

/// What a datagram tells about its sender: "is called 'baraka server'", "writes baraka/session",
/// "reads baraka/hello"; empty if it tells nothing of that kind.
std::vector<std::string> attempts_in(hal::rtps::Octets datagram);

/// The users whose data a participant refuses. The first datagram of each user is logged, with its
/// process if that can be seen; later datagrams are only counted. Any thread.
class Strangers {
 public:
  Strangers(Trust trust, hal::Clock& clock) : trust_(std::move(trust)), clock_(clock) {}

  /// Whether to refuse data of this sender; a refusal is noted. Reads the kernel's table of sockets
  /// unless the sender was refused a moment ago.
  bool refuse(hal::rtps::Octets datagram, const UdpSender& sender);

  const Trust& trust() const { return trust_; }

  /// One line for each user: "user 1002: 57 datagrams; it is called 'x', writes baraka/session".
  std::vector<std::string> summary() const;

 private:
  struct Stranger {
    std::uint64_t datagrams = 0;
    std::set<std::string> attempts;
  };
  struct Refused {
    std::optional<uid_t> user;
    hal::Time until{};
  };

  /// The refusal of this sender, recent or new; null: it is accepted.
  const Refused* refused_at(const UdpSender& sender, std::string& news);
  std::string introduction(const SenderJudgement& judgement, const UdpSender& sender) const;

  const Trust trust_;
  hal::Clock& clock_;
  mutable std::mutex mutex_;
  std::map<UdpSender, Refused> refused_;
  std::map<std::optional<uid_t>, Stranger> strangers_;  ///< None: the user cannot be determined.
};

}  // namespace gateway::guard
