#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hal/types/random.h"
#include "sim/radio/mac/carrier_sense.h"
#include "sim/radio/mac/channel_access.h"
#include "sim/radio/mac/frame_factory.h"
#include "sim/radio/mac/frame_sequence.h"
#include "sim/radio/mac/mac_base.h"
#include "sim/radio/mac/originator.h"
#include "sim/radio/mac/recipient.h"
#include "sim/radio/phy/radio.h"

namespace sim::radio {

/// The MAC of IEEE Std 802.11-2020, clause 10: distributed channel access with DCF or, for QoS
/// stations, EDCA, and Block Ack. It joins the parts: ChannelAccess says when, Originator what,
/// FrameSequence in which frames; Recipient handles what others send.
class Ieee80211Mac final : public MacBase,
                           public RadioListener,
                           private ChannelAccessListener,
                           private FrameSequenceListener,
                           private RecipientListener {
 public:
  struct Streams {
    hal::RandomStream backoff;
    hal::RandomStream rates;  ///< Random numbers of the rate control.
    std::uint64_t flows = 0;  ///< Seed of flow_hash().
  };
  /// @param config  outlives the MAC.
  Ieee80211Mac(const Context& context, const DcfConfig& config, Radio& radio,
               const Streams& streams);

  MacCapabilities capabilities() const override { return {.tx_status = true, .rssi = true}; }
  void transmit(const MacRequest& request) override;
  void set_radio(bool on) override;
  bool radio_on() const override { return radio_.state() != Radio::State::kOff; }
  /// Of the function of best effort.
  std::size_t room() const override { return originator_.room(originator_.function_of({})); }
  std::size_t waiting() const override { return originator_.waiting(); }
  RadioUse use() const override { return radio_.use(); }
  void set_use_listener(RadioUseListener* listener) override { radio_.set_use_listener(listener); }
  /// As Protection::follow().
  void follow(std::optional<HtProtection> told) { originator_.protection().follow(told); }

  /// Replaces the parameters of EDCA; no effect on a station without QoS.
  void set_edca(const EdcaConfig& edca) { access_.set(edca, carrier_.timing()); }

  /// Queues of receivers; null if there are none. Whoever sets their client in place of this MAC
  /// pushes MSDUs through queue() and calls serve(), also when client.is_open() has become true.
  MsduQueues* queues() { return originator_.queues(); }
  /// @return false: the queue is full. @pre queues() is not null.
  bool queue(WaitingMsdu waiting);
  void serve();

 private:
  std::size_t queued() const override { return originator_.waiting(); }

  void on_medium_busy() override { carrier_.update(); }
  void on_medium_idle() override { carrier_.on_medium_idle(); }
  void on_receive_start() override {}
  void on_receive(const ReceivedPpdu& received) override;
  void on_receive_error(ReceiveError error) override;
  void on_transmit_end(const Ppdu& ppdu) override { sequence_.on_transmit_end(ppdu); }
  void on_access(ContentionFunction function) override;
  void on_internal_collision(ContentionFunction function) override;
  void on_exchange_end(ExchangeEnd end, const BlockAckFields* answer) override;
  void on_mpdu(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) override;
  void send_action(const Frame& about, const BlockAckAction& action) override;

  void ask(ContentionFunction function);
  void go_on(ContentionFunction function, bool window_starts_anew);
  bool continues_txop(const Exchange& exchange);
  void end_all(const EndedMsdus& ended);
  void end_all_later(EndedMsdus& ended);
  void on_unicast(const ReceivedPpdu& received);
  void charge_sender(const Ppdu& ppdu);
  void on_action(const Frame& frame);
  void on_amsdu(const Frame& frame, hal::Dbm rssi, hal::Decibels snr);

  /// Its own requests in queues of receivers.
  class OwnRequests final : public MsduQueueClient {
   public:
    explicit OwnRequests(Ieee80211Mac& mac) : mac_(mac) {}
    std::optional<MacRequest> on_turn(WaitingMsdu waiting) override {
      return std::move(waiting.request);
    }
    void on_dropped(WaitingMsdu waiting, hal::Verdict verdict) override {
      mac_.report_later(std::move(waiting.request), verdict);
    }

   private:
    Ieee80211Mac& mac_;
  };

  const DcfConfig& config_;
  Radio& radio_;
  // What every frame on the air needs comes first, for the cache.
  ChannelAccess access_;
  CarrierSense carrier_;
  FrameSequence sequence_;
  FrameFactory frames_;
  Originator originator_;
  Recipient recipient_;
  hal::Time txop_end_{};  ///< Of the current TXOP, if its function has a limit.
  std::unique_ptr<OwnRequests> own_requests_;  ///< Null without queues of receivers.
};

}  // namespace sim::radio
