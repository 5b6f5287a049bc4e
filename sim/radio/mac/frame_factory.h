#pragma once

#include "hal/types/agent_id.h"
#include "sim/radio/mac/frame.h"
#include "sim/radio/phy/mode_set.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Makes the frames of one station, with the Duration fields of IEEE Std 802.11-2016, 9.2.5.
class FrameFactory {
 public:
  /// @param lengths,modes  outlive the factory and the frames.
  FrameFactory(const LengthsConfig& lengths, const ModeSet& modes, hal::AgentId agent)
      : lengths_(lengths), modes_(modes), agent_(agent) {}

  struct DataOptions {
    std::uint16_t sequence = 0;
    bool retry = false;
    hal::Duration duration{};
    const PhyMode* mode = nullptr;  ///< Null: data_mode().
    hal::Time at{};                 ///< Start of the frame, for the timestamp of beacons.
    bool qos = false;
    std::uint32_t bits = 0;  ///< Length of the MPDU; 0: that of the payload with headers.
  };
  /// Makes a data or management frame.
  std::shared_ptr<Frame> data(const MacRequest& request, const DataOptions& options);

  /// @param duration  of the rest of the exchange after the RTS.
  FramePtr rts(hal::AgentId to, hal::Duration duration);
  FramePtr rts(hal::AgentId to, hal::Duration duration, const PhyMode& mode);
  /// @param duration  of the rest of the exchange after the CTS.
  FramePtr cts_to_self(hal::Duration duration, const PhyMode& mode);
  /// @param duration  of the rest of the exchange after the BlockAckReq.
  FramePtr block_ack_request(hal::AgentId to, const BlockAckFields& fields, hal::Duration duration,
                             const PhyMode& mode);
  /// Answers a BlockAckReq or an A-MPDU. @param snr  Frame::answered_snr.
  FramePtr block_ack(const Frame& to, const BlockAckFields& fields, hal::Decibels snr = {});
  /// Make the responses to an RTS and to a data frame. The duration of the CTS is that of the RTS
  /// without CTS and SIFS. @param snr  Frame::answered_snr.
  FramePtr cts(const Frame& rts, hal::Duration sifs);
  FramePtr ack(const Frame& data, hal::Decibels snr = {});

  const PhyMode& data_mode(const MacRequest& request) const;
  hal::Duration data_airtime(const MacRequest& request) const;
  hal::Duration data_airtime(const MacRequest& request, const PhyMode& mode) const;
  /// Airtime of the CTS or ACK that answers a frame sent in mode `to`.
  hal::Duration response_airtime(FrameType type, const PhyMode& to) const;

 private:
  std::shared_ptr<Frame> blank(FrameType type, hal::AgentId to);
  static void send_in(const PhyMode& mode, std::uint32_t bits, Frame& frame);
  std::shared_ptr<Frame> control(FrameType type, const PhyMode& mode, hal::AgentId to,
                                 hal::Duration duration);

  const LengthsConfig& lengths_;
  const ModeSet& modes_;
  hal::AgentId agent_;
  std::uint64_t made_ = 0;
};

}  // namespace sim::radio
