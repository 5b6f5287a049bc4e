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

/// The processes that sent Hello to a server, with their participants: an instance belongs to the
/// participant that named it first, as long as that one exists. One thread.
class Visitors {
 public:
  /// Most Hellos of one process at a time. Each takes a participant of its own.
  static constexpr std::size_t kMostOfProcess = 64;

  /// @param trust  which users are heard; null: all. Outlives this object.
  explicit Visitors(const guard::Trust* trust) : trust_(trust) {}

  /// Notes a Hello.
  /// @param sender  source address of its participant; none: unknown.
  /// Errors: kProtocol: it must not be answered, because it names the instance of another process,
  ///   or because its process has sent too many.
  hal::Result<void> receive(const hal::node::exchange::Hello& hello, const Origin& origin,
                            const std::optional<guard::UdpSender>& sender);

  /// Whose Hello it was; none: of nobody who is there.
  std::optional<Origin> origin_of(const std::string& instance) const;

  /// Whether an instance is gone, or was not heard for the liveliness lease.
  bool is_silent(const std::string& instance) const;

  /// A writer of Hellos is gone. @return the instances that are gone with it.
  std::vector<std::string> leave(const Origin& writer);
  /// A writer of Hellos was not heard for the liveliness lease: the same, but for processes of this
  /// host that live. A debugger may hold them.
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
