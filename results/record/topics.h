#pragma once

#include <memory>
#include <utility>

#include "results/record/commits.h"
#include "results/record/protocols.h"
#include "sim/agents/observer_list.h"
#include "sim/agents/simulation_config.h"
#include "sim/scenario/detail.h"

namespace results::record {

struct RecorderOptions {
  hal::Duration pose_period = std::chrono::seconds{1};
  sim::scenario::Detail frames = sim::scenario::Detail::kCounts;
  sim::scenario::Detail messages = sim::scenario::Detail::kAll;
  /// DDS samples, for runs in which an agent has a network.
  sim::scenario::Detail samples = sim::scenario::Detail::kCounts;
  /// kAll: each change of a route, and the lengths of queues.
  sim::scenario::Detail routes = sim::scenario::Detail::kNone;
  sim::scenario::Detail readings = sim::scenario::Detail::kNone;  ///< See LookLog::Settings.
  sim::scenario::Detail inputs = sim::scenario::Detail::kAll;     ///< From outside.

  bool counts_frames() const { return frames != sim::scenario::Detail::kNone; }
};

/// What the writers of a run need, and the lists to which they are added.
struct Recording {
  Database& database;
  const RecorderOptions& options;
  const sim::agents::SimulationConfig& config;
  const Protocols& protocols;  ///< Outlives the writers.
  Commits& commits;
  sim::agents::ObserverList& listeners;

  template <class One, class... Parts>
  void add(Parts&&... parts) {
    auto one = std::make_unique<One>(std::forward<Parts>(parts)...);
    listeners.add(*one);
    commits.add(std::move(one));
  }
};

/// Makes the writers of all topics that the options ask for.
void add_writers(Recording& recording);

}  // namespace results::record
