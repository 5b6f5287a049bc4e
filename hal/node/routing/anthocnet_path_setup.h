#pragma once

#include <functional>
#include <map>
#include <utility>

#include "hal/node/routing/anthocnet_ants.h"
#include "hal/node/routing/anthocnet_backlog.h"

namespace hal::node::routing::anthocnet {

/// Reactive path setup at the source of a session ([PPSN], 3.1): sends a reactive ant, up to
/// `retries` times, one every retry_period less a random share of it (RoutingConfig::retry_jitter).
///
///   begin() --> ant, t0 --retry_period--> ant --retry_period--> … --> given up: waiting messages
///   end
///                |                         |
///                +------ ant returns ------+--> found, took now - t0
///
/// The search also succeeds if, when a period ends, a trail exists that was not laid by its own
/// ants, for example because the destination has come near.
class PathSetup {
 public:
  /// @param on_trail  sends the messages that wait for a target; called when a search ends by such
  ///   a trail.
  PathSetup(AntNode ants_node, Diffusion& diffusion, Ants& ants, Backlog& backlog,
            std::function<void(const Target&)> on_trail)
      : node_(ants_node.node),
        table_(ants_node.table),
        diffusion_(diffusion),
        ants_(ants),
        backlog_(backlog),
        on_trail_(std::move(on_trail)) {}

  /// Starts a search unless one is running.
  void begin(const Target& target);
  bool is_on(const Target& target) const { return searches_.contains(target); }

  /// An ant has returned. It ends the search only if it belongs to this search: late answers to an
  /// earlier one describe an outdated network.
  void on_home(const Target& target, Sequence sequence);

 private:
  struct Search {
    Time started{};
    Sequence first_sequence = 0;
    int tries = 0;
    OwnTimers::Handle retry = 0;
  };

  void try_once(const Target& target);
  Duration wait_after(int tries);
  void on_retry(const Target& target);
  void end(const Target& target, bool found);

  Node& node_;
  const PheromoneTable& table_;
  Diffusion& diffusion_;
  Ants& ants_;
  Backlog& backlog_;
  std::function<void(const Target&)> on_trail_;
  std::map<Target, Search> searches_;
};

}  // namespace hal::node::routing::anthocnet
