#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "hal/node/routing/aodv_message.h"
#include "hal/node/routing/node.h"

namespace hal::node::routing {

/// Routing table entry of one destination (RFC 3561, section 2).
struct AodvEntry {
  AgentId next_hop;
  int hops = 0;
  std::optional<AodvSequence> sequence{};  ///< nullopt: no valid number is known.
  /// False: the route is broken or expired; its sequence number is kept.
  bool is_valid = false;
  /// The route may be used for messages; false: it only records that the neighbour was heard.
  bool is_in_use = false;
  bool is_in_repair = false;  ///< Not valid, but being repaired (section 6.12).
  /// Expiry of a valid route; otherwise the time when the entry is deleted.
  Time expires{};
  std::set<AgentId> precursors{};  ///< Neighbours that send to the destination through this node.
};

/// A route to a destination that a message offers.
struct AodvOffer {
  AgentId destination;
  AgentId next_hop;
  int hops = 0;
  std::optional<AodvSequence> sequence{};
  Time expires{};
};

/// The routing table of AODV (RFC 3561, section 6.2): one next hop for each destination, for all
/// message classes.
///
///   (no entry) --offer--> valid --not used, broken--> invalid --DELETE_PERIOD--> (no entry)
///                           ^                            |
///                           +--------newer offer---------+
///
/// A sequence number is incremented when its route breaks, and also when it expires, if it was in
/// use. Both preserve the order that prevents loops: along a route, (number, -hops) increases (R.
/// van Glabbeek, P. Hoefner, W. L. Tan, M. Portmann, "Sequence Numbers Do Not Guarantee Loop
/// Freedom", 2013, on what the RFC leaves open).
///
/// A route is reported to the observer once for each class that was seen at this node. Of the path
/// statistics only the number of hops is known.
class AodvTable {
 public:
  /// @param config  of the node; both outlive the table.
  explicit AodvTable(Node& node) : node_(node) {}

  /// Null: no entry.
  const AodvEntry* find(AgentId destination) const;
  /// Null: there is no valid route.
  const AodvEntry* active(AgentId destination) const;

  /// Accepts an offer if its sequence number is newer than the known one, or equal with fewer hops,
  /// or equal while no valid route is known.
  /// @return whether it was accepted.
  bool offer(const AodvOffer& offer);

  /// A frame of the neighbour was received: it is considered a direct neighbour at least until
  /// then.
  void note_neighbour(AgentId neighbour, Time until);

  /// The route is used: it stays valid at least until then. No effect if it is not valid.
  void use(AgentId destination, Time until);
  void add_precursor(AgentId destination, AgentId neighbour);

  /// The route is broken. @param newest  the sequence number in a route error; nullopt: it is
  /// incremented here. @return the entry; null: it was not valid.
  const AodvEntry* invalidate(AgentId destination, std::optional<AodvSequence> newest);
  /// Clears the precursors: no neighbour needs a notification of its loss any more.
  void forget_precursors(AgentId destination);
  bool is_in_use(AgentId destination) const;
  void set_in_use(AgentId destination, bool in_use);
  void set_in_repair(AgentId destination, bool in_repair);

  /// Destinations of valid routes via this neighbour.
  std::vector<AgentId> via(AgentId neighbour) const;
  /// Whether this node may have to forward messages.
  bool is_on_active_route() const;

  /// A message of this class was seen: from now on its routes are reported.
  void note_class(std::string_view topic);

  std::vector<Route> routes(std::string_view topic, AgentId destination) const;
  std::vector<Route> routes() const;

 private:
  bool is_active(const AodvEntry& entry) const {
    return entry.is_valid && entry.expires > node_.now();
  }
  void tell(AgentId destination, const AodvEntry& entry, bool removed) const;
  void wait_for(Time expiry);
  void on_expiry();

  Node& node_;
  std::map<AgentId, AodvEntry> entries_;
  std::set<std::string, std::less<>> classes_;
  std::optional<Time> wake_at_;  ///< When the timer fires; nullopt: it is not set.
  OwnTimers::Handle timer_ = 0;
};

}  // namespace hal::node::routing
