#pragma once

#include <cstdint>

#include "sim/radio/cell.h"
#include "sim/radio/mac/frame_factory.h"
#include "sim/radio/phy/mode_set.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Frame that precedes a data frame and reserves the medium for it.
enum class Opening : std::uint8_t {
  kNone,
  kCtsToSelf,  ///< A CTS addressed to its transmitter (IEEE Std 802.11-2016, 10.3.2.12).
  kRts,
};

/// How one station opens its exchanges: RTS/CTS above the threshold (10.3.2.7), and protection of
/// OFDM frames where there are stations that do not support OFDM, and of HT, VHT and HE frames
/// where there are stations that do not support HT (10.26; IEEE Std 802.11-2020, 10.27). Protecting
/// frames are sent in what every station receives, DSSS if one does not support OFDM, and their
/// Duration covers the exchange.
class Protection {
 public:
  /// @param config,modes,cell  outlive this object.
  Protection(const DcfConfig& config, const ModeSet& modes, const Cell& cell);

  /// @param bits  of the MPDU, with FCS.
  Opening opening(bool is_group, const PhyMode& data, std::uint32_t bits) const;

  /// Mode of that RTS or CTS.
  const PhyMode& mode(hal::AgentId to, const PhyMode& data) const;

 private:
  bool protects(const PhyMode& data) const;
  bool needs_dsss(hal::AgentId to, const PhyMode& data) const;

  const DcfConfig& config_;
  const ModeSet& modes_;
  const Cell& cell_;
  ProtectionKind kind_;  ///< Resolved: never kAuto.
  bool protects_ofdm_ = false, protects_ht_ = false;
};

}  // namespace sim::radio
