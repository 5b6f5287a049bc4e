#pragma once

#include <cstdint>

#include "hal/types/random.h"
#include "sim/radio/mac/frame_factory.h"
#include "sim/radio/mac/mac_base.h"
#include "sim/radio/mac/tx_queue.h"
#include "sim/radio/phy/radio.h"

namespace sim::radio {

/// MAC of the Mobility Framework 1.0a5, which the paper used: CSMA/CA with RTS/CTS that differs
/// from the standard's DCF in ways that affect the paper's figures, e.g. no backoff for a packet
/// that finds the station idle, and no post-backoff. Written from its description in
/// docs/models.md, 4; source as imported into INET in 2005: MF80211/Mac80211.
///
///            packet, radio idle              RTS sent             CTS
///   kIdle --------------------> kContend -------------> kWaitCts -----> (SIFS, DATA)
///     ^ ^                        | |  ^ ^                   |                |
///     | |   broadcast sent       | |  | +-- timeout --------+                v
///     | +------------ kBusy <----+ |  +---- timeout -------------------- kWaitAck
///     |                 ^          | no RTS: DATA sent                    ^  |
///     |                 |          +--------------------------------------+  |
///     +--- queue empty -|----------------------------------- ACK ------------+
///                       | (SIFS, ACK)
///   kIdle, kContend --RTS for us, (SIFS, CTS)--> kWaitData --DATA--> kBusy --> next cycle
///   any --frame for others with a duration, or bit error--> kQuiet --NAV over--> next cycle
///
/// "Next cycle": contend for the head of the queue, or kIdle. A carrier cancels a running
/// contention, which keeps its remaining time, and a pending SIFS answer.
class MobilityFrameworkMac final : public MacBase, public RadioListener {
 public:
  /// @param config  outlives the MAC.
  MobilityFrameworkMac(const Context& context, const MobilityFrameworkConfig& config, Radio& radio,
                       hal::RandomStream backoff);

  MacCapabilities capabilities() const override { return {.tx_status = true, .rssi = true}; }
  void transmit(const MacRequest& request) override;
  void set_radio(bool on) override;
  bool radio_on() const override { return radio_.state() != Radio::State::kOff; }
  std::size_t room() const override { return queue_.room(); }
  std::size_t waiting() const override { return queue_.size(); }
  RadioUse use() const override { return radio_.use(); }
  void set_use_listener(RadioUseListener* listener) override { radio_.set_use_listener(listener); }

 private:
  enum class State : std::uint8_t { kIdle, kContend, kWaitCts, kWaitData, kWaitAck, kBusy, kQuiet };

  /// An event and its time.
  struct Timer {
    EventQueue::EventId event;
    hal::Time due{};
  };

  std::size_t queued() const override { return queue_.size(); }

  void on_medium_busy() override;
  void on_medium_idle() override;
  void on_receive_start() override {}
  void on_receive(const ReceivedPpdu& received) override;
  void on_receive_error(ReceiveError error) override;
  void on_transmit_end(const Ppdu& ppdu) override;

  void on_rts(const Frame& frame);
  void on_cts(const Frame& frame);
  void on_data(const Frame& frame, hal::Dbm rssi, hal::Decibels snr);
  void on_ack();
  void on_overheard(const Frame& frame);

  void next_cycle();
  void contend(bool without_backoff);
  hal::Duration backoff();
  void on_contention_won();
  void send_and_wait(const FramePtr& frame, State next, hal::Duration timeout);
  void answer(FramePtr frame);
  void send_answer();
  void on_timeout();
  void keep_quiet(hal::Duration duration);
  MacRequest pop();

  FramePtr make_rts();
  FramePtr make_data();
  bool uses_rts(const MacRequest& request) const;
  hal::Duration airtime_of(FrameType type) const {
    return frames_.response_airtime(type, modes().control());
  }

  template <class F>
  void start(Timer& timer, hal::Duration delay, F&& handler);
  void stop(Timer& timer) { events().cancel(timer.event); }
  bool is_running(const Timer& timer) const { return events().is_pending(timer.event); }
  /// Whether it is running and not due now: a signal sensed now cannot stop a timer that is due
  /// now.
  bool can_stop(const Timer& timer) const { return is_running(timer) && timer.due != now(); }

  const MobilityFrameworkConfig& config_;
  Radio& radio_;
  FrameFactory frames_;
  hal::RandomStream random_;
  hal::Duration difs_;
  hal::Duration eifs_;

  State state_ = State::kIdle;
  TxQueue queue_;
  std::uint32_t attempt_ = 1;
  hal::Duration backoff_left_{};

  Timer contention_;
  hal::Time contending_since_{};
  Timer sifs_;  ///< Until answer_ is sent.
  FramePtr answer_;
  hal::Duration data_due_{};  ///< Timeout for the data frame, from the start of this station's CTS.
  Timer timeout_;
  Timer nav_;
  Timer busy_;
};

}  // namespace sim::radio
