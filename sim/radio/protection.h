#pragma once

#include <cstdint>

#include "sim/radio/cell.h"
#include "sim/radio/frame_factory.h"
#include "sim/radio/mode_set.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// What goes out before a data frame, so that others keep quiet for it.
enum class Opening : std::uint8_t {
  kNone,
  kCtsToSelf,  ///< A CTS to its own sender (IEEE Std 802.11-2016, 10.3.2.12).
  kRts,
};

/// How one station opens its exchanges: RTS/CTS above the threshold (10.3.2.7), and protection of
/// frames in OFDM where there are stations that do not know it (10.26). What protects is in DSSS,
/// which all receive, and its Duration covers the exchange.
class Protection {
 public:
  /// All outlive it.
  Protection(const DcfConfig& config, const ModeSet& modes, const Cell& cell);

  /// @param bits  of the MPDU.
  Opening opening(bool is_group, const PhyMode& data, std::uint32_t bits) const;

  /// Of that RTS or CTS.
  const PhyMode& mode(hal::AgentId to, const PhyMode& data) const;

 private:
  bool protects(const PhyMode& data) const;

  const DcfConfig& config_;
  const ModeSet& modes_;
  const Cell& cell_;
  ProtectionKind kind_;  ///< Not kAuto.
};

}  // namespace sim::radio
