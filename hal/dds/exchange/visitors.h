#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hal/dds/exchange/origin.h"
#include "hal/dds/process_watch.h"
#include "hal/dds/trust.h"
#include "hal/dds/udp_sender.h"
#include "hal/exchange/session.h"
#include "hal/types/result.h"

namespace hal::dds {

/// Who has said Hello to a server, and from which participant: an instance belongs to the one that
/// named it first, for as long as that one is there. One thread.
class Visitors {
 public:
  /// Most Hellos of one process at a time. Each takes a participant of its own.
  static constexpr std::size_t kMostOfProcess = 64;

  /// @param trust  which users are heard; null: all. Outlives this object.
  explicit Visitors(const Trust* trust) : trust_(trust) {}

  /// Notes a Hello.
  /// @param sender  where its participant speaks from; none: not known.
  /// Errors: kProtocol: it is not to be answered, because somebody else is meant by it, or because
  ///   its process has said too many.
  Result<void> receive(const exchange::Hello& hello, const Origin& origin,
                       const std::optional<UdpSender>& sender);

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
    ProcessIdentity process;
    bool is_silent = false;
  };
  template <class Predicate>
  std::vector<std::string> erase(const Predicate& is_gone);
  std::size_t count(const ProcessIdentity& process) const;

  const Trust* trust_;
  std::map<std::string, Visitor> visitors_;  ///< By instance.
};

}  // namespace hal::dds
