#pragma once

#include <cstdint>
#include <memory>

#include "hal/types/random.h"
#include "sim/radio/backoff.h"
#include "sim/radio/dcf_timing.h"
#include "sim/radio/duplicate_filter.h"
#include "sim/radio/frame_factory.h"
#include "sim/radio/mac_base.h"
#include "sim/radio/nav.h"
#include "sim/radio/protection.h"
#include "sim/radio/radio.h"
#include "sim/radio/rate_control.h"
#include "sim/radio/rate_ladder.h"
#include "sim/radio/retry.h"
#include "sim/radio/tx_queue.h"

namespace sim::radio {

/// Distributed coordination function (IEEE Std 802.11-2016, 10.3): the sender's frame exchange, and
/// the answers to the frames of others.
///
///              on_access(): RTS              CTS came: SIFS, DATA
///   kIdle ----------------------> kWaitCts ----------------------> kWaitAck
///     ^ |                             |                              ^  |
///     | +-- on_access(): short DATA --|------------------------------+  |
///     | +-- on_access(): broadcast ---|--> kBroadcasting                |
///     | +-- on_access(): CTS to itself, SIFS, and as without it         |
///     +-- frame sent, ACK came, or no answer: backoff, maybe again -----+
///
/// Backoff decides when to start; radio and NAV tell it what the medium does. RTS and DATA of
/// others are answered after SIFS whatever the state.
class DcfMac final : public MacBase, public RadioListener, private AccessListener {
 public:
  struct Streams {
    hal::RandomStream backoff;
    hal::RandomStream rates;  ///< Of the rate control.
  };
  /// @param config  outlives it.
  DcfMac(const Context& context, const DcfConfig& config, Radio& radio, const Streams& streams);

  MacCapabilities capabilities() const override { return {.tx_status = true, .rssi = true}; }
  void transmit(const MacRequest& request) override;
  void set_radio(bool on) override;
  bool radio_on() const override { return radio_.state() != Radio::State::kOff; }
  std::size_t room() const override { return queue_.room(); }
  std::size_t waiting() const override { return queue_.size(); }
  RadioUse use() const override { return radio_.use(); }
  void set_use_listener(RadioUseListener* listener) override { radio_.set_use_listener(listener); }

 private:
  enum class State : std::uint8_t { kIdle, kReserving, kBroadcasting, kWaitCts, kWaitAck };

  std::size_t queued() const override { return queue_.size(); }

  void on_medium_busy() override { update_medium(); }
  void on_medium_idle() override;
  void on_receive_start() override {}
  void on_receive(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) override;
  void on_receive_error(ReceiveError error) override;
  void on_transmit_end(const Frame& frame) override;
  void on_access() override;

  // The medium.
  void update_medium();
  void begin_eifs();
  void set_nav(const Frame& frame);
  void reset_nav_unless_used(hal::Time since);

  // As sender.
  void ask_for_medium();
  void send(const FramePtr& frame);
  void on_no_answer();
  void fail();
  void succeed();
  MacRequest end_service(bool count_time);
  bool is_expired();
  void discard_expired();
  bool has_rate_control();
  void choose_exchange();
  void open_exchange();
  FramePtr make_rts();
  FramePtr make_cts_to_self();
  FramePtr make_data();
  hal::Duration after_data();
  hal::Duration data_and_after();

  // As receiver.
  void on_unicast(const Frame& frame, hal::Dbm rssi, hal::Decibels snr);
  void on_data(const Frame& frame, hal::Dbm rssi, hal::Decibels snr);
  void answer(FramePtr frame);

  const DcfConfig& config_;
  Radio& radio_;
  FrameFactory frames_;
  DcfTiming timing_;
  Backoff backoff_;
  ContentionWindow window_;
  RetryCounters retries_;
  TxQueue queue_;
  RateLadders ladders_;
  std::unique_ptr<RateControl> rates_;
  Protection protection_;
  Nav nav_;
  DuplicateFilter duplicates_;

  State state_ = State::kIdle;
  const PhyMode* data_mode_ = nullptr;  ///< This and the next: of the exchange that is going on.
  Opening opening_ = Opening::kNone;
  bool awaiting_ = false;        ///< Its RTS or DATA has gone out; what comes in now is the answer.
  bool last_was_wrong_ = false;  ///< The last frame came in with an error: EIFS when idle.
  FramePtr answer_;              ///< Goes out at the end of the SIFS.
  EventQueue::EventId sifs_;
  EventQueue::EventId no_answer_;
  EventQueue::EventId nav_end_;
  EventQueue::EventId nav_reset_;
};

}  // namespace sim::radio
