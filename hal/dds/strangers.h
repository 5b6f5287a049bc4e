#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hal/dds/trust.h"
#include "hal/dds/udp_sender.h"
#include "hal/rtps/cursor.h"
#include "hal/types/clock.h"
#include "hal/types/time.h"

namespace hal::dds {

/// What a datagram says its sender is or wants: "is called 'baraka server'", "writes
/// baraka/session", "reads baraka/hello"; empty if it says nothing of the kind.
std::vector<std::string> attempts_in(hal::rtps::Octets datagram);

/// The users whom a participant does not hear. Each is named in the log once, with its process if
/// this one may know it; later only counted. Any thread.
class Strangers {
 public:
  Strangers(Trust trust, Clock& clock) : trust_(std::move(trust)), clock_(clock) {}

  /// Whether what comes from there is not to be heard; if so, it is noted. Costs a look at the
  /// kernel's table of sockets, unless the sender was refused a moment ago.
  bool refuse(hal::rtps::Octets datagram, const UdpSender& sender);

  const Trust& trust() const { return trust_; }

  /// "user 1002: 57 datagrams; it is called 'x', writes baraka/session", one for each.
  std::vector<std::string> summary() const;

 private:
  struct Stranger {
    std::uint64_t datagrams = 0;
    std::set<std::string> attempts;
  };
  struct Refused {
    std::optional<uid_t> user;
    Time until{};
  };

  /// The user who was refused there lately, or is now; nothing: it is to be heard.
  const Refused* refused_at(const UdpSender& sender, std::string& news);
  std::string introduction(const SenderJudgement& judgement, const UdpSender& sender) const;

  const Trust trust_;
  Clock& clock_;
  mutable std::mutex mutex_;
  std::map<UdpSender, Refused> refused_;
  std::map<std::optional<uid_t>, Stranger> strangers_;  ///< None: whose user cannot be told.
};

}  // namespace hal::dds
