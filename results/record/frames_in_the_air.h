#pragma once

#include <cstdint>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "results/record/database.h"
#include "results/record/schema.h"
#include "sim/radio/mac/frame.h"
#include "sim/radio/mac/frame_class.h"

namespace results::record {

/// Writes the tables in_the_air and in_the_air_ended: frames whose ends are not yet known at all
/// radios. Each station has at most one, or those of one A-MPDU.
class FramesInTheAir {
 public:
  /// @param tail  maximum propagation delay: how long after its end at the transmitter a frame can
  /// end at receivers.
  FramesInTheAir(Database& database, hal::Duration tail);

  static std::vector<Table> tables();

  void on_frame_start(hal::Time at, const sim::radio::Frame& frame);
  void on_frame_cut(hal::Time at, const sim::radio::Frame& frame);
  void on_reception(const sim::radio::Frame& frame, hal::AgentId receiver) {
    if (frame.transmitter.value >= last_.size()) return;
    Last& last = last_[frame.transmitter.value];
    if (last.frame == frame.id) last.ended_at.push_back(receiver);
  }

  /// Replaces the content of the tables by the frames that are in the air at `now`. A frame that
  /// ends at `now` still counts; the radios at which it has ended are listed.
  void write(hal::Time now);

 private:
  struct Last {
    std::uint64_t frame = 0;  ///< The first of an A-MPDU; 0: none was sent yet.
    std::uint32_t ampdu = 0, frames = 0;
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
