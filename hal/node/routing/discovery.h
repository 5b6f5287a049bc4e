#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "hal/node/routing/outbox.h"

namespace hal::node::routing {

/// Searches for routes, and keeps the messages that wait for them.
///
///   wait() --> forward ant, t0 --retry_period--> forward ant --retry_period--> … --> given up
///                   |            less jitter         |         less jitter
///                   +------------- backward ant -----+--> found, took now - t0
///
/// The first ant is sent at once, each further one after retry_period less a random share of it, so
/// that nodes whose first ants collided do not repeat them simultaneously.
class Discovery {
 public:
  /// Ends a message that waited without success.
  using Abandon = std::function<void(const Transit&, Verdict)>;

  Discovery(Node& node, Outbox& outbox, Abandon abandon)
      : node_(node), outbox_(outbox), abandon_(std::move(abandon)) {}

  /// Keeps a message until release(), at most for buffer_age, and searches for a route to its
  /// destination unless a search is running. Abandons it at once (kQueueFull) if buffer_limit
  /// messages wait already.
  void wait(Transit transit);

  /// A backward ant has returned. It ends the search if it answers one of this search's forward
  /// ants: late answers to an earlier search describe an outdated network.
  void on_answer(const std::string& topic, AgentId destination, Sequence sequence);

  /// Removes and returns all messages that wait for a route, in order of arrival.
  std::vector<Transit> release(const std::string& topic, AgentId destination);

 private:
  using Target = std::pair<std::string, AgentId>;  ///< Topic, destination.
  struct Waiting {
    Transit transit;
    OwnTimers::Handle expiry = 0;
  };
  struct Search {
    Time started{};
    Sequence first_sequence = 0;
    int tries = 0;
    OwnTimers::Handle retry = 0;
  };

  void begin(const Target& target);
  void try_once(const Target& target, Search& search);
  Duration wait_after(int tries);
  void on_retry(const Target& target);
  void give_up(const Target& target);
  void on_expiry(const Target& target, Sequence place);

  Node& node_;
  Outbox& outbox_;
  Abandon abandon_;
  std::map<Target, Search> searches_;
  Sequence last_place_ = 0;
  std::map<Target, std::map<Sequence, Waiting>> waiting_;  ///< By place in the queue.
};

}  // namespace hal::node::routing
