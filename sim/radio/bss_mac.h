#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "sim/radio/dcf_mac.h"

namespace sim::radio {

/// The common part of an access point and the stations of its BSS: a queue above the DCF, which
/// gets one frame at a time, so that waiting frames can take another path after a handover. Beacons
/// precede other management frames, and those precede data.
class BssMac : public MacBase, protected FrameListener {
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
  /// A request of a client, or of another station for which an access point passes it on.
  struct Waiting {
    MacRequest request;  ///< To its final destination.
    hal::AgentId source;
    hal::Time since{};       ///< When it came; its lifetime counts from then.
    bool over_wire = false;  ///< It left by the wire, for another access point.
  };

  /// @param config  outlives it.
  BssMac(const Context& context, const DcfConfig& config, std::unique_ptr<DcfMac> dcf);

  /// The frame for a request whose turn it is; none: it goes another way, which this has seen to.
  virtual std::optional<MacRequest> frame_for(const Waiting& waiting) = 0;
  /// Whether data may be sent now.
  virtual bool is_open() const { return true; }
  virtual void on_management_sent(const MacRequest& request, hal::Verdict verdict) = 0;
  virtual void on_radio(bool on) = 0;

  /// A data frame of the BSS, in the words of its third address (table 9-26).
  static MacRequest data_frame(const Waiting& waiting, hal::AgentId receiver, Ds ds);

  /// Sends frames that may be sent now. Call it when is_open() may have become true.
  void serve();
  /// @return false: the queue is full.
  bool queue_data(Waiting waiting);
  void send_management(FrameType type, hal::AgentId to, hal::AgentId bssid, hal::Bytes body);
  /// A data frame for this station has come in, and been acknowledged, that cannot be used here.
  void lose(const Frame& frame);
  /// What `source` sent ends here, and was not in the queue.
  void lose_relay(hal::AgentId source, const MacRequest& request, hal::Verdict verdict);
  /// The request ended, in an event of its own.
  void end_later(Waiting waiting, hal::Verdict verdict);

 private:
  std::size_t queued() const final { return data_.size() + (serving_ ? 1u : 0u); }
  void on_sent(const MacRequest& request, hal::Verdict verdict) final;
  void end(const Waiting& waiting, hal::Verdict verdict);
  void discard_expired();
  void hand_down(const MacRequest& frame);

  const DcfConfig& config_;
  std::unique_ptr<DcfMac> dcf_;
  std::deque<MacRequest> management_;
  std::deque<Waiting> data_;
  bool is_busy_ = false;            ///< The DCF has a frame.
  std::optional<Waiting> serving_;  ///< Of which it is, if it is data.
  hal::Time serving_since_{};
};

}  // namespace sim::radio
