#pragma once

#include <functional>
#include <map>
#include <utility>

#include "hal/node/routing/anthocnet_ants.h"
#include "hal/node/routing/anthocnet_backlog.h"

namespace hal::node::routing::anthocnet {

/// Reactive path setup at the source of a session ([PPSN], 3.1): a reactive ant, and again after
/// retry_period, less a random share of it (RoutingConfig::retry_jitter), `retries` times in all.
///
///   begin() --> ant, t0 --retry_period--> ant --retry_period--> … --> given up: what waits ends
///                |                         |
///                +------ ant comes home ---+--> found, took now - t0
///
/// Found as well if the time is up and a trail is there that no ant of this search laid: the
/// destination has come near, say.
class PathSetup {
 public:
  /// @param on_trail  sends what waits for a target; when a search ends by a trail of others.
  PathSetup(AntNode ants_node, Diffusion& diffusion, Ants& ants, Backlog& backlog,
            std::function<void(const Target&)> on_trail)
      : node_(ants_node.node),
        table_(ants_node.table),
        diffusion_(diffusion),
        ants_(ants),
        backlog_(backlog),
        on_trail_(std::move(on_trail)) {}

  /// Starts a search unless one is on.
  void begin(const Target& target);
  bool is_on(const Target& target) const { return searches_.contains(target); }

  /// An ant came home. It ends the search if it is one of this search's: late answers to an earlier
  /// one speak of an older network.
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
