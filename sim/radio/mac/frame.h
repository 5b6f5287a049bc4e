#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/radio/mac/block_ack_fields.h"
#include "sim/radio/mac/mac_header.h"
#include "sim/radio/mac/mac_sap.h"
#include "sim/radio/phy/phy_mode.h"

namespace sim::radio {

/// One MSDU of an A-MSDU (IEEE Std 802.11-2020, 9.3.2.2.2).
struct AmsduPart {
  hal::AgentId source{};
  hal::AgentId destination{};
  Ethertype ethertype = 0;
  Payload payload{};
  std::uint64_t tag = 0;
};

/// Contents of a frame and its transmission parameters. Its transmitter makes it once; all
/// receivers share it unchanged. codec.h converts it to bytes where bytes are needed.
struct Frame {
  /// Transmitter in the upper 16 bits, number among the frames of that transmitter in the rest.
  std::uint64_t id = 0;
  FrameType type = FrameType::kData;
  hal::AgentId transmitter{};
  hal::AgentId receiver{};   ///< kEveryone: broadcast.
  hal::Duration duration{};  ///< Duration field: how long the exchange continues after this frame.
  std::uint16_t sequence = 0;  ///< Data and management: 0..4095.
  bool retry = false;          ///< Data and management: sent before with this sequence number.
  Ds ds = Ds::kNone;           ///< Data.
  hal::AgentId address3{};     ///< Data and management, as in MacHeader.
  hal::BitsPerSecond rate{};   ///< Rate of the MPDU.
  /// Mode of transmission; outlives the frame. Null if the frame was decoded from bytes.
  const PhyMode* mode = nullptr;
  std::uint32_t air_length = 0;  ///< Length of the MPDU with FCS, bits.
  /// Preamble, PLCP header and MPDU; of an A-MPDU the part that this MPDU takes.
  hal::Duration airtime{};
  std::uint8_t priority = 0;  ///< Data.
  Ethertype ethertype = 0;    ///< Data.
  Payload payload{};          ///< Data: payload; management: frame body (management.h).
  std::uint64_t tag = 0;      ///< Data: the tag of the client's request.
  GroupAddress group = 0;     ///< Data to kEveryone: as in MacRequest.
  bool qos = false;           ///< Data: has the QoS header, whose TID is the priority.
  /// Number of its A-MPDU among those of the transmitter, from 1 on; 0: not in an A-MPDU.
  std::uint32_t ampdu = 0;
  bool is_last_of_ampdu = false;
  /// In an A-MPDU: sum of the airtimes of the MPDUs before it, and of all.
  hal::Duration airtime_before{}, airtime_of_all{};
  /// ACK and BlockAck: the lowest SINR that their transmitter had over the PPDU which they answer.
  /// Not part of the frame: only the rate control `ideal` may know it.
  hal::Decibels answered_snr{};
  std::shared_ptr<const BlockAckFields> block_ack{};  ///< BlockAck and BlockAckReq.
  /// A-MSDU: its MSDUs; payload, ethertype and tag are those of the first.
  std::shared_ptr<const std::vector<AmsduPart>> amsdu{};

  /// Airtime of its PPDU.
  hal::Duration ppdu_airtime() const { return ampdu == 0 ? airtime : airtime_of_all; }
  bool is_broadcast() const { return receiver == hal::kEveryone; }
  /// Data: original source and final destination, whatever access points lie between.
  hal::AgentId source() const { return ds == Ds::kFrom ? address3 : transmitter; }
  hal::AgentId destination() const { return ds == Ds::kTo ? address3 : receiver; }
  /// Whether only stations of a BSS can interpret it.
  bool is_of_bss() const { return ds != Ds::kNone || is_management(type); }
};

using FramePtr = std::shared_ptr<const Frame>;

}  // namespace sim::radio
