#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "hal/node/routing/aodv_table.h"
#include "hal/node/routing/outbox.h"
#include "hal/node/routing/rate_limit.h"

namespace hal::node::routing {

/// Searches for routes with route requests, and keeps the messages that wait for them (RFC 3561,
/// sections 6.3 and 6.4).
///
///   wait() --> ring of TTL_START hops, or the last known hop count + TTL_INCREMENT
///                 | RING_TRAVERSAL_TIME (R8): wider by TTL_INCREMENT, up to TTL_THRESHOLD
///                 v
///              the whole network --NET_TRAVERSAL_TIME (R1), doubled each time--> … RREQ_RETRIES
///                 v                                                             v more
///              on_route(): found                                             given up
///
/// A repair (section 6.12) is one ring of a given width. If it fails, messages of other nodes are
/// abandoned, and those of this node wait for a search as above.
class AodvSearch {
 public:
  struct Calls {
    /// Ends a message that waited without success.
    std::function<void(const Transit&, Verdict)> abandon;
    /// A repair found no route.
    std::function<void(AgentId destination)> repair_failed;
  };

  AodvSearch(Node& node, AodvTable& table, Outbox& outbox, Calls calls);

  /// Keeps a message until release(), at most for buffer_age, and searches for a route to its
  /// destination unless a search is running. Abandons it at once (kQueueFull) if buffer_limit
  /// messages wait already.
  void wait(Transit transit);
  /// Searches once, within `ttl` hops.
  /// @return false: a search is running, and continues unchanged.
  bool repair(AgentId destination, int ttl);

  /// There is a route: ends the search, and returns the messages that waited for it, in order of
  /// arrival.
  std::vector<Transit> on_route(AgentId destination);

  /// Sequence number for a reply of this node; it never decreases.
  AodvSequence own_sequence() const { return own_sequence_; }
  void raise_own_sequence(AodvSequence at_least);
  /// No search starts before that time.
  void hold_until(Time at) { held_until_ = at; }
  bool is_held() const { return node_.now() < held_until_; }

 private:
  struct Waiting {
    Transit transit;
    OwnTimers::Handle expiry = 0;
  };
  struct Search {
    std::string topic;  ///< Topic of the first message that waited.
    Time started{};
    int ttl = 0;
    int whole = 0;  ///< Requests so far that covered the whole network.
    bool is_repair = false;
    OwnTimers::Handle timer = 0;
  };

  void begin(AgentId destination, const std::string& topic);
  int first_ttl(AgentId destination) const;
  void try_once(AgentId destination);
  void request(AgentId destination, Search& search);
  Duration wait_after(const Search& search) const;
  void on_timeout(AgentId destination);
  void give_up(AgentId destination);
  void search_for_own(AgentId destination);
  std::vector<Transit> release(AgentId destination);
  void on_expiry(AgentId destination, Sequence place);

  Node& node_;
  AodvTable& table_;
  Outbox& outbox_;
  Calls calls_;
  AodvSequence own_sequence_;
  std::uint32_t last_id_;
  Time held_until_{};
  RateLimit rate_;
  std::map<AgentId, Search> searches_;
  Sequence last_place_ = 0;
  std::map<AgentId, std::map<Sequence, Waiting>> waiting_;  ///< By place in the queue.
};

}  // namespace hal::node::routing
