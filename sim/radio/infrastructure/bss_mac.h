#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>

#include "sim/radio/mac/ieee80211_mac.h"

namespace sim::radio {

/// The common part of an access point and of the stations of its BSS: a queue above the DCF, which
/// gets one frame at a time, so that waiting frames can take another path after a handover; with
/// QoS as many as two A-MPDUs can have. Where receivers have queues of their own (QueuesConfig),
/// data wait in those of the DCF instead. Beacons precede other management frames, and those
/// precede data.
class BssMac : public MacBase, protected FrameListener, protected MsduQueueClient {
 public:
  MacCapabilities capabilities() const final { return dcf_->capabilities(); }
  void transmit(const MacRequest& request) final;
  void set_radio(bool on) final;
  bool radio_on() const final { return dcf_->radio_on(); }
  std::size_t room() const final;
  std::size_t waiting() const final { return queued(); }
  RadioUse use() const final { return dcf_->use(); }
  void set_use_listener(RadioUseListener* listener) final { dcf_->set_use_listener(listener); }

 protected:
  using Waiting = WaitingMsdu;

  /// @param config  outlives the MAC.
  BssMac(const Context& context, const DcfConfig& config, std::unique_ptr<Ieee80211Mac> dcf);

  /// Makes the frame for the request whose turn it is. @return nullopt if the request takes another
  /// path, which this call has started.
  virtual std::optional<MacRequest> frame_for(const Waiting& waiting) = 0;
  /// Whether data may be sent now.
  bool is_open() const override { return true; }
  virtual void on_management_sent(const MacRequest& request, hal::Verdict verdict) = 0;
  virtual void on_radio(bool on) = 0;

  /// As Protection::follow().
  void follow(std::optional<HtProtection> told) { dcf_->follow(told); }
  /// Makes a data frame of the BSS; `receiver` and `ds` determine its addresses (table 9-26).
  static MacRequest data_frame(const Waiting& waiting, hal::AgentId receiver, Ds ds);

  /// Contends with these parameters from now on. @param edca  nullopt: those of the station itself.
  void use_edca(const std::optional<EdcaConfig>& edca) {
    dcf_->set_edca(edca.value_or(config_.edca));
  }
  /// Sends frames that may be sent now. Call it when is_open() may have become true.
  void serve();
  /// Queues a request. @return false if the queue is full.
  bool queue_data(Waiting waiting);
  void send_management(FrameType type, hal::AgentId to, hal::AgentId bssid, hal::Bytes body);
  /// Reports a data frame that this station received and acknowledged but cannot use.
  void lose(const Frame& frame);
  /// Reports that a frame from `source` is lost here without having been queued.
  void lose_relay(hal::AgentId source, const MacRequest& request, hal::Verdict verdict);
  /// Reports the end of a request in a separate event.
  void end_later(Waiting waiting, hal::Verdict verdict);

 private:
  std::size_t queued() const final;
  bool push(Waiting waiting);
  std::optional<MacRequest> on_turn(WaitingMsdu waiting) final;
  void on_dropped(WaitingMsdu waiting, hal::Verdict verdict) final;
  void on_sent(const MacRequest& request, hal::Verdict verdict) final;
  void end(const Waiting& waiting, hal::Verdict verdict);
  void discard_expired();
  void hand_down(const MacRequest& frame);

  const DcfConfig& config_;
  std::unique_ptr<Ieee80211Mac> dcf_;
  MsduQueues* queues_;  ///< Of the DCF; null if data wait in data_.
  std::deque<MacRequest> management_;
  std::deque<Waiting> data_;
  /// A request that the DCF has.
  struct Serving {
    Waiting waiting;
    hal::Time since{};
  };
  std::size_t most_handed_;                   ///< Frames that the DCF may have.
  std::size_t handed_ = 0;                    ///< Frames that it has, with queues_ without data.
  std::map<std::uint64_t, Serving> serving_;  ///< Data among them, by their tickets.
  std::uint64_t tickets_ = 0;                 ///< Number of tickets given out.
  hal::Time last_end_{};                      ///< When a frame of the DCF ended.
};

}  // namespace sim::radio
