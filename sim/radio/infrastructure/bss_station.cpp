#include "sim/radio/infrastructure/bss_station.h"

#include <algorithm>
#include <utility>

namespace sim::radio {
BssStation::BssStation(const Context& context, const DcfConfig& config,
                       std::unique_ptr<Ieee80211Mac> dcf, Membership membership)
    : BssMac(context, config, std::move(dcf)),
      access_points_(std::move(membership.access_points)),
      has_ht_(membership.bss.capabilities.has_value()),
      association_(context.events, {context.agent, std::move(membership.bss), membership.scan},
                   membership.config, *this) {
  association_.start();
}

void BssStation::on_frame(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) {
  if (frame.type == FrameType::kBeacon) return on_beacon(frame, rssi);
  if (is_management(frame.type)) {
    association_.on_management(frame);
    return heed(frame);
  }
  if (frame.ds == Ds::kFrom && may_use(frame.transmitter)) return on_data(frame, rssi, snr);
  // From an ad hoc network, or from an access point that it may not use.
  if (!frame.is_broadcast()) lose(frame);
}

bool BssStation::may_use(hal::AgentId access_point) const {
  return std::ranges::find(access_points_, access_point) != access_points_.end();
}

/// Group frames are accepted by their BSSID, other frames by the receiver address alone
/// (9.3.2.1.2), so frames that the previous access point still sends are received, too.
void BssStation::on_data(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) {
  const std::optional<hal::AgentId> ours = association_.access_point();
  if (frame.is_broadcast()) {
    if (frame.transmitter == ours && frame.source() != agent()) deliver(frame, rssi, snr);
    return;
  }
  if (ours) return deliver(frame, rssi, snr);
  lose(frame);
}

void BssStation::on_beacon(const Frame& frame, hal::Dbm rssi) {
  if (may_use(frame.transmitter)) association_.on_beacon(frame, rssi);
  heed(frame);
}

/// Follows what its access point says of protection.
void BssStation::heed(const Frame& frame) {
  if (!has_ht_ || frame.transmitter != association_.access_point()) return;
  if (frame.type == FrameType::kBeacon) {
    if (const auto beacon = decode_beacon(*frame.payload)) {
      follow(beacon->bss.ht_operation.protection);
    }
  } else if (frame.type == FrameType::kAssociationResponse ||
             frame.type == FrameType::kReassociationResponse) {
    if (const auto response = decode_association_response(*frame.payload)) {
      follow(response->bss.ht_operation.protection);
    }
  }
}

std::optional<MacRequest> BssStation::frame_for(const Waiting& waiting) {
  return data_frame(waiting, *association_.access_point(), Ds::kTo);
}

void BssStation::on_management_sent(const MacRequest& request, hal::Verdict verdict) {
  if (verdict == hal::Verdict::kDelivered || verdict == hal::Verdict::kRadioOff) return;
  association_.on_unanswered(request.header.type, request.destination);
}

void BssStation::on_radio(bool on) { on ? association_.start() : association_.stop(); }

void BssStation::send(FrameType type, hal::AgentId access_point, hal::Bytes body) {
  send_management(type, access_point, access_point, std::move(body));
}

void BssStation::on_association() {
  const std::optional<hal::AgentId> now_with = association_.access_point();
  if (now_with != told_) {
    told_ = now_with;
    if (!now_with) follow(std::nullopt);
    use_edca(now_with ? association_.edca() : std::nullopt);
    observer().on_association(now(), agent(), now_with);
  }
  serve();
}

}  // namespace sim::radio
