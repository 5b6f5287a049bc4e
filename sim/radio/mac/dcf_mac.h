#pragma once

#include <cstdint>
#include <memory>

#include "hal/types/random.h"
#include "sim/radio/mac/backoff.h"
#include "sim/radio/mac/dcf_timing.h"
#include "sim/radio/mac/duplicate_filter.h"
#include "sim/radio/mac/frame_factory.h"
#include "sim/radio/mac/mac_base.h"
#include "sim/radio/mac/nav.h"
#include "sim/radio/mac/protection.h"
#include "sim/radio/mac/retry.h"
#include "sim/radio/mac/tx_queue.h"
#include "sim/radio/phy/radio.h"
#include "sim/radio/rate/rate_control.h"
#include "sim/radio/rate/rate_ladder.h"

namespace sim::radio {

/// Distributed coordination function (IEEE Std 802.11-2016, 10.3): the frame exchange of the
/// transmitter, and the responses to frames of others.
///
///              on_access(): RTS              CTS received: SIFS, DATA
///   kIdle ----------------------> kWaitCts ----------------------> kWaitAck
///     ^ |                             |                              ^  |
///     | +-- on_access(): short DATA --|------------------------------+  |
///     | +-- on_access(): broadcast ---|--> kBroadcasting                |
///     | +-- on_access(): CTS-to-self, SIFS, then DATA or broadcast      |
///     +-- frame sent, ACK, or timeout: backoff, perhaps a retry --------+
///
/// Backoff decides when to start; it learns the state of the medium from the radio and the NAV. RTS
/// and DATA frames of others are answered after SIFS in any state.
class DcfMac final : public MacBase, public RadioListener, private AccessListener {
 public:
  struct Streams {
    hal::RandomStream backoff;
    hal::RandomStream rates;  ///< Random numbers of the rate control.
  };
  /// @param config  outlives the MAC.
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
  void on_receive(const ReceivedPpdu& received) override;
  void on_receive_error(ReceiveError error) override;
  void on_transmit_end(const Ppdu& ppdu) override;
  void on_access() override;

  // Carrier sense.
  void update_medium();
  void begin_eifs();
  void set_nav(const Frame& frame);
  void reset_nav_unless_used(hal::Time since);

  // Transmitter.
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

  // Receiver.
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
  /// Mode of the data frame of the current exchange; opening_ also belongs to that exchange.
  const PhyMode* data_mode_ = nullptr;
  Opening opening_ = Opening::kNone;
  /// The RTS or DATA frame has been sent; the next frame received is taken for the response.
  bool awaiting_ = false;
  bool last_was_wrong_ = false;  ///< The last reception failed: EIFS when the medium is idle.
  FramePtr answer_;              ///< The response to be sent after SIFS.
  EventQueue::EventId sifs_;
  EventQueue::EventId no_answer_;
  EventQueue::EventId nav_end_;
  EventQueue::EventId nav_reset_;
};

}  // namespace sim::radio
