#include "sim/radio/mac/protection.h"

namespace sim::radio {
namespace {

ProtectionKind resolved(ProtectionKind kind, const Cell& cell) {
  if (kind != ProtectionKind::kAuto) return kind;
  return cell.is_mixed() ? ProtectionKind::kCtsToSelf : ProtectionKind::kNone;
}

}  // namespace

Protection::Protection(const DcfConfig& config, const ModeSet& modes, const Cell& cell)
    : config_(config), modes_(modes), cell_(cell), kind_(resolved(config.protection, cell)) {}

bool Protection::protects(const PhyMode& data) const {
  return kind_ != ProtectionKind::kNone && data.modulation_class() == ModulationClass::kOfdm;
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
  if (is_ofdm && (protects(data) || !cell_.knows_ofdm(to))) {
    return modes_.at(config_.protection_rate);
  }
  // Rate control has chosen a lower rate: an RTS at a higher rate than the data would be lost.
  const bool is_automatic = config_.rate_control.kind != RateControlKind::kFixed;
  if (is_automatic && control.rate() > data.rate()) return modes_.response_to(data);
  return control;
}

}  // namespace sim::radio
