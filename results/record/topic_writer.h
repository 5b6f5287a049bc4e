#pragma once

#include <cstdint>

#include "hal/types/time.h"
#include "sim/agents/observer.h"
#include "sim/agents/simulation.h"

namespace results::record {

/// Writes the tables of one topic of a record. A derived class is final, overrides the callbacks of
/// Observer that it needs, and gives the SQL text of its tables by static functions; topics.cpp
/// registers it.
class TopicWriter : public sim::agents::Observer {
 public:
  /// Estimate of what write() would write; tables with few rows in any run are left out.
  struct Pending {
    std::uint64_t rows = 0;
    std::uint64_t counted = 0;  ///< Frames, messages, ... that these rows stand for.
  };

  /// Called before the run, for writers that poll the simulation. @param simulation  outlives the
  /// writer.
  virtual void look_at(const sim::agents::Simulation& simulation) { (void)simulation; }
  /// Writes the totals that have changed since the last call. All other rows are written at once
  /// and reported to Commits.
  virtual void write(hal::Time now) { (void)now; }
  virtual Pending pending() const { return {}; }
  /// Called when the run has ended, before the totals are written for the last time: decides what
  /// is still open.
  virtual void finish(hal::Time ended_at) { (void)ended_at; }
};

}  // namespace results::record
