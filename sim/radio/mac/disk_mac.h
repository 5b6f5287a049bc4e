#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "sim/radio/channel/neighbourhood.h"
#include "sim/radio/mac/frame_factory.h"
#include "sim/radio/mac/mac_base.h"
#include "sim/radio/phy/timed_state.h"

namespace sim::radio {

class DiskMac;

/// Medium of the profiles disk and ideal: every station within the range receives every frame.
struct DiskAir {
  Neighbourhood& neighbourhood;
  std::vector<DiskMac*> stations;  ///< By StationIndex.
};

/// MAC of the profiles without a physical layer. `disk`: the frames of a station take length over
/// bit rate each, are sent one after the other, and never collide. `ideal`: the same, but frames
/// take no time. A frame is received by the stations that are within range when it starts and
/// switched on when it ends. A unicast frame whose destination is not among them ends with
/// kRetryLimit.
class DiskMac final : public MacBase {
 public:
  /// Adds itself to `air`. @param queue_limit  frames; nullopt: unlimited.
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
  /// @return whether the destination received the frame.
  bool end_at_receivers(bool cut);
  void receive(const Frame& frame);

  DiskAir& air_;
  std::optional<std::uint32_t> queue_limit_;
  FrameFactory frames_;
  StationIndex index_;
  TimedState<State, 3> state_;
  std::uint16_t next_sequence_ = 0;
  std::deque<MacRequest> queue_;
  FramePtr sending_;  ///< Frame of the head of the queue; null if none is on the air.
  std::vector<StationIndex> receivers_;
  EventQueue::EventId end_;
};

}  // namespace sim::radio
