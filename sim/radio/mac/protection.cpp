#include "sim/radio/mac/protection.h"

namespace sim::radio {
Protection::Protection(const DcfConfig& config, const ModeSet& modes, const Cell& cell)
    : config_(config),
      modes_(modes),
      cell_(cell),
      kind_(config.protection == ProtectionKind::kAuto ? ProtectionKind::kCtsToSelf
                                                       : config.protection),
      ht_(of_cell()) {
  const bool is_auto = config.protection == ProtectionKind::kAuto;
  const bool is_any = kind_ != ProtectionKind::kNone;
  protects_ofdm_ = is_auto ? cell.is_mixed() : is_any;
}

/// As in an IBSS, all stations count as members.
HtProtection Protection::of_cell() const {
  return ht_protection({.non_ht_members = cell_.without_ht() > 0,
                        .narrow_members = cell_.narrowest() < cell_.widest(),
                        .width = cell_.widest()});
}

bool Protection::protects_ht(const PhyMode& data) const {
  if (config_.protection != ProtectionKind::kAuto) return kind_ != ProtectionKind::kNone;
  constexpr std::uint16_t kNarrow = 20;
  switch (ht_) {
    case HtProtection::kNone:
      return false;
    case HtProtection::k20Mhz:
      return config_.wide_protection && data.width() > kNarrow;
    case HtProtection::kNonmember:
    case HtProtection::kNonHtMixed:
      return true;
  }
  return true;
}

bool Protection::protects(const PhyMode& data) const {
  if (has_streams(data.modulation_class())) return protects_ht(data);
  return data.modulation_class() == ModulationClass::kOfdm && protects_ofdm_;
}

/// Whether the opening must be in DSSS.
bool Protection::needs_dsss(hal::AgentId to, const PhyMode& data) const {
  if (!cell_.capabilities(to).supports(ModulationClass::kOfdm)) return true;
  if (!protects(data)) return false;
  return !has_streams(data.modulation_class()) || !cell_.all_support(ModulationClass::kOfdm);
}

Opening Protection::opening(bool is_group, const PhyMode& data, std::uint32_t bits) const {
  const bool is_long = bits > 8 * config_.contention.rts_threshold;
  if (!is_group && is_long) return Opening::kRts;
  if (!protects(data)) return Opening::kNone;
  // No station answers an RTS to a group.
  return kind_ == ProtectionKind::kRtsCts && !is_group ? Opening::kRts : Opening::kCtsToSelf;
}

const PhyMode& Protection::mode(hal::AgentId to, const PhyMode& data) const {
  const PhyMode& control = modes_.control();
  const bool is_ofdm = control.modulation_class() == ModulationClass::kOfdm;
  if (is_ofdm && needs_dsss(to, data)) return modes_.at(config_.protection_rate);
  // Rate control has chosen a lower rate: an RTS at a higher rate than the data would be lost.
  const bool is_automatic = config_.rate_control.kind != RateControlKind::kFixed;
  if (is_automatic && control.rate() > data.reference_rate()) return modes_.response_to(data);
  return control;
}

}  // namespace sim::radio
