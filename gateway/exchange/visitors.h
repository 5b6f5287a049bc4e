#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gateway/exchange/origin.h"
#include "gateway/guard/trust.h"
#include "gateway/guard/udp_sender.h"
#include "gateway/process/process_watch.h"
#include "hal/node/exchange/session.h"
#include "hal/types/result.h"

namespace gateway::exchange {

/// The processes that sent a Hello to a server, with their participants. An instance belongs to the
/// participant that named it first, as long as that participant exists. One thread.
class Visitors {
 public:
  /// Maximum number of Hellos of one process at a time. Each needs a participant of its own.
  static constexpr std::size_t kMostOfProcess = 64;

  /// @param trust  which users are accepted; null: all. Outlives this object.
  explicit Visitors(const guard::Trust* trust) : trust_(trust) {}

  /// Notes a Hello.
  /// @param sender  source address of its participant; none: unknown.
  /// Errors: kProtocol: it must not be answered, because it names the instance of another
  /// participant, its process is not the one that it claims to be, or its process has sent too
  /// many.
  hal::Result<void> receive(const hal::node::exchange::Hello& hello, const Origin& origin,
                            const std::optional<guard::UdpSender>& sender);

  /// Origin of the Hello of an instance; none if the instance is not present.
  std::optional<Origin> origin_of(const std::string& instance) const;

  /// Whether an instance is gone, or was silent for the liveliness lease.
  bool is_silent(const std::string& instance) const;

  /// Call when a writer of Hellos has left. @return the instances that are gone with it.
  std::vector<std::string> leave(const Origin& writer);
  /// Call when a writer of Hellos was silent for the liveliness lease. The same, except that live
  /// processes on this host stay: a debugger may have stopped them.
  std::vector<std::string> fall_silent(const Origin& writer);

 private:
  struct Visitor {
    Origin origin;
    process::ProcessIdentity process;
    bool is_silent = false;
  };
  template <class Predicate>
  std::vector<std::string> erase(const Predicate& is_gone);
  std::size_t count(const process::ProcessIdentity& process) const;

  const guard::Trust* trust_;
  std::map<std::string, Visitor> visitors_;  ///< By instance.
};

}  // namespace gateway::exchange
