#pragma once

#include <cstdint>
#include <optional>

#include "sim/radio/cell.h"
#include "sim/radio/mac/frame_factory.h"
#include "sim/radio/mac/ht_protection.h"
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
/// as HtProtection says (10.26; IEEE Std 802.11-2020, 10.27): members of a BSS do what their access
/// point tells them, others judge by the stations on their channel. Protecting frames are sent in
/// what every station receives, DSSS if one does not support OFDM, and their Duration covers the
/// exchange.
///
/// All HT frames are in the mixed format, and HT stations of 20 MHz defer to wider ones, for which
/// the standard asks for no protection in 20 MHz protection mode (interpretation 1 of IEEE Std
/// 802.11n-2009, 2012). DcfConfig::wide_protection does what Linux's drivers do: iwlwifi, mt76,
/// rt2800.
class Protection {
 public:
  /// @param config,modes,cell  outlive this object.
  Protection(const DcfConfig& config, const ModeSet& modes, const Cell& cell);

  /// @param bits  of the MPDU, with FCS.
  Opening opening(bool is_group, const PhyMode& data, std::uint32_t bits) const;

  /// What the access point has told; nullopt: the station is in no BSS.
  void follow(std::optional<HtProtection> told) { ht_ = told.value_or(of_cell()); }

  /// Mode of that RTS or CTS.
  const PhyMode& mode(hal::AgentId to, const PhyMode& data) const;

 private:
  HtProtection of_cell() const;
  bool protects(const PhyMode& data) const;
  bool protects_ht(const PhyMode& data) const;
  bool needs_dsss(hal::AgentId to, const PhyMode& data) const;

  const DcfConfig& config_;
  const ModeSet& modes_;
  const Cell& cell_;
  ProtectionKind kind_;  ///< Resolved: never kAuto.
  bool protects_ofdm_ = false;
  HtProtection ht_;  ///< With kAuto.
};

}  // namespace sim::radio
