#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "sim/radio/frame_factory.h"
#include "sim/radio/mac_base.h"
#include "sim/radio/neighbourhood.h"
#include "sim/radio/timed_state.h"

namespace sim::radio {

class DiskMac;

/// Medium of the profiles disk and ideal: all stations within the range receive every frame.
struct DiskAir {
  Neighbourhood& neighbourhood;
  std::vector<DiskMac*> stations;  ///< By StationIndex.
};

/// Link without physics. `disk`: the frames of a station take length over bit rate each, go
/// out one after the other, and never collide. `ideal`: the same with no time at all. A unicast
/// frame whose destination is out of range or off when it ends, ends in kRetryLimit. Receivers are
/// those within range when the frame starts, and on when it ends.
class DiskMac final : public MacBase {
 public:
  /// Adds itself to `air`. @param queue_limit  frames; none: as many as there are.
  DiskMac(const Context& context, std::optional<std::uint32_t> queue_limit, DiskAir& air);

  MacCapabilities capabilities() const override { return {.tx_status = true, .rssi = false}; }
  void transmit(const MacRequest& request) override;
  void set_radio(bool on) override;
  bool radio_on() const override { return state_ != State::kOff; }
  std::size_t room() const override;
  std::size_t waiting() const override { return queue_.size(); }
  RadioUse use() const override {
    return {
        state_.spent(State::kTransmit), {}, state_.spent(State::kIdle), state_.spent(State::kOff)};
  }
  void set_use_listener(RadioUseListener* listener) override { state_.tell(listener); }

 private:
  enum class State : std::uint8_t { kOff, kIdle, kTransmit };
  friend RadioActivity activity_of(State state) {
    if (state == State::kOff) return RadioActivity::kOff;
    return state == State::kIdle ? RadioActivity::kListening : RadioActivity::kTransmitting;
  }

  std::size_t queued() const override { return queue_.size(); }
  void start_head();
  void finish_head();
  /// @return whether the frame was delivered to its destination.
  bool end_at_receivers(bool cut);
  void receive(const Frame& frame);

  DiskAir& air_;
  std::optional<std::uint32_t> queue_limit_;
  FrameFactory frames_;
  StationIndex index_;
  TimedState<State, 3> state_;
  std::uint16_t next_sequence_ = 0;
  std::deque<MacRequest> queue_;
  FramePtr sending_;  ///< The head's; null: nothing is on the air.
  std::vector<StationIndex> receivers_;
  EventQueue::EventId end_;
};

}  // namespace sim::radio
