#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "hal/node/routing/outbox.h"

namespace hal::node::routing {

/// Looks for routes, and keeps the messages that wait for them.
///
///   wait() --> forward ant, t0 --retry_period--> forward ant --retry_period--> … --> given up
///                   |            less jitter         |         less jitter
///                   +------------- backward ant -----+--> found, took now - t0
///
/// The first ant leaves at once, each further one after retry_period less a random share of it:
/// nodes that began in one instant, and lost their ants to each other, come apart.
class Discovery {
 public:
  /// What to do with a message that waited in vain.
  using Abandon = std::function<void(const Transit&, Verdict)>;

  Discovery(Node& node, Outbox& outbox, Abandon abandon)
      : node_(node), outbox_(outbox), abandon_(std::move(abandon)) {}

  /// Keeps a message until release(), for buffer_age at most, and looks for a route to its
  /// destination if no search is on. Abandons it at once (kQueueFull) if buffer_limit wait already.
  void wait(Transit transit);

  /// A backward ant came home. It ends the search if it answers one of this search's forward ants:
  /// late answers to an earlier search speak of an older network.
  void on_answer(const std::string& topic, AgentId destination, Sequence sequence);

  /// Takes out all messages that wait for a route, in order of arrival.
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
