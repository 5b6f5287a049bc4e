#pragma once

#include <cstdint>

#include "hal/types/time.h"
#include "sim/agents/observer.h"
#include "sim/agents/simulation.h"

namespace results::record {

/// Writes the tables of one topic of a run: it observes what they are of, and has their SQL text as
/// static functions. A final class; topics.cpp registers it.
class TopicWriter : public sim::agents::Observer {
 public:
  /// What write() would write, about, without what is few in any case.
  struct Pending {
    std::uint64_t rows = 0;
    std::uint64_t counted = 0;  ///< Frames, messages, ... that these rows stand for.
  };

  /// Before the run: to look at what nobody tells of. It outlives the writer.
  virtual void look_at(const sim::agents::Simulation& simulation) { (void)simulation; }
  /// Writes the totals that changed since the last call. Other rows are written when they come, and
  /// told to Commits.
  virtual void write(hal::Time now) { (void)now; }
  virtual Pending pending() const { return {}; }
  /// The run ended: settles what was open, before totals are written for the last time.
  virtual void finish(hal::Time ended_at) { (void)ended_at; }
};

}  // namespace results::record
