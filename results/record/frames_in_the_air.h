#pragma once

#include <cstdint>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "results/record/database.h"
#include "results/record/schema.h"
#include "sim/radio/frame.h"
#include "sim/radio/frame_class.h"

namespace results::record {

/// The tables in_the_air and in_the_air_ended: frames of which it cannot be said yet how they end
/// at every radio. Each station has one at most.
class FramesInTheAir {
 public:
  /// @param tail  how long after its end at the transmitter a frame may still come to an end at
  ///   others.
  FramesInTheAir(Database& database, hal::Duration tail);

  static std::vector<Table> tables();

  void on_frame_start(hal::Time at, const sim::radio::Frame& frame);
  void on_frame_cut(hal::Time at, const sim::radio::Frame& frame);
  void on_reception(const sim::radio::Frame& frame, hal::AgentId receiver) {
    if (frame.transmitter.value >= last_.size()) return;
    Last& last = last_[frame.transmitter.value];
    if (last.frame == frame.id) last.ended_at.push_back(receiver);
  }

  /// Replaces what is in the tables by what is in the air at `now`. A frame that ends now is, but
  /// for the radios at which it has ended.
  void write(hal::Time now);

 private:
  struct Last {
    std::uint64_t frame = 0;  ///< 0: none was sent yet.
    hal::AgentId receiver{};
    sim::radio::FrameClass kind{};
    hal::Time end{};
    std::vector<hal::AgentId> ended_at;
  };

  Statement clear_, clear_ended_, insert_, insert_ended_;
  hal::Duration tail_;
  std::vector<Last> last_;  ///< By address of the transmitter.
};

}  // namespace results::record
