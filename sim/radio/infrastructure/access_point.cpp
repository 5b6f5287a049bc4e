#include "sim/radio/infrastructure/access_point.h"

#include <algorithm>
#include <utility>

namespace sim::radio {

AccessPoint::AccessPoint(const Context& context, const DcfConfig& config,
                         std::unique_ptr<Ieee80211Mac> dcf, const Network& network)
    : BssMac(context, config, std::move(dcf)), network_(network) {
  network_.distribution.add(*this);
  update_ht_operation();
  schedule_beacon(now() + network_.first_beacon);
}

/// IEEE Std 802.11-2020, 10.27.3.1, from the stations that are associated now. Stations without HT
/// on the channel are detected from the start.
void AccessPoint::update_ht_operation() {
  if (!network_.bss.capabilities) return;
  HtSurroundings around{.width = network_.bss.capabilities->width};
  std::size_t non_ht = 0;
  for (const auto& [station, id] : associated_) {
    const Capabilities of = cell().capabilities(station);
    const bool has_ht = of.supports(ModulationClass::kHt);
    if (!has_ht) ++non_ht;
    around.narrow_members = around.narrow_members || (has_ht && of.width < around.width);
  }
  around.non_ht_members = non_ht > 0;
  around.non_ht_others = cell().without_ht() > non_ht;
  network_.bss.ht_operation = {.protection = ht_protection(around),
                               .non_greenfield = associated_.size() > non_ht,
                               .obss_non_ht = around.non_ht_others};
  follow(network_.bss.ht_operation.protection);
}

/// 11.1.3.2: target times do not depend on whether beacons are actually sent.
void AccessPoint::schedule_beacon(hal::Time target) {
  events().schedule(target, Rank::kRadio, agent(), [this, target] {
    if (radio_on() && !beacon_waits_) send_beacon();
    schedule_beacon(target + network_.config.beacon_interval);
  });
}

void AccessPoint::send_beacon() {
  beacon_waits_ = true;
  send_management(
      FrameType::kBeacon, hal::kEveryone, agent(),
      encode(Beacon{
          .timestamp = now(), .interval = network_.config.beacon_interval, .bss = network_.bss}));
}

void AccessPoint::on_radio(bool on) {
  if (on) return;
  beacon_waits_ = false;
  authenticated_.clear();
  offered_.clear();
  for (const auto& [station, id] : std::exchange(associated_, {})) {
    network_.distribution.release(station, agent());
  }
  update_ht_operation();
}

void AccessPoint::on_frame(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) {
  if (is_management(frame.type)) return on_management(frame);
  if (frame.receiver != agent()) return;
  if (frame.ds == Ds::kTo) return on_data(frame, rssi, snr);
  lose(frame);  // from an ad hoc network
}

void AccessPoint::on_management(const Frame& frame) {
  switch (frame.type) {
    case FrameType::kAuthentication:
      return on_authentication(frame);
    case FrameType::kAssociationRequest:
    case FrameType::kReassociationRequest:
      return on_association_request(frame);
    case FrameType::kDisassociation:
    case FrameType::kDeauthentication:
      return forget(frame.transmitter);
    default:
      return;  // beacons of other access points, and responses, which are for stations
  }
}

void AccessPoint::answer(FrameType type, hal::AgentId station, hal::Bytes body) {
  send_management(type, station, agent(), std::move(body));
}

/// Open System authentication accepts every station (12.3.3.2).
void AccessPoint::on_authentication(const Frame& frame) {
  const auto request = decode_authentication(*frame.payload);
  if (!request || request->transaction != 1) return;
  authenticated_.insert(frame.transmitter);
  answer(FrameType::kAuthentication, frame.transmitter, encode(Authentication{.transaction = 2}));
}

std::optional<std::uint16_t> AccessPoint::free_association_id() const {
  const auto taken = [](const auto& ids, std::uint16_t id) {
    return std::ranges::any_of(ids, [id](const auto& entry) { return entry.second == id; });
  };
  if (associated_.size() + offered_.size() >= kMaxAssociationId) return std::nullopt;
  std::uint16_t id = 1;
  while (taken(associated_, id) || taken(offered_, id)) ++id;
  return id;
}

void AccessPoint::on_association_request(const Frame& frame) {
  const hal::AgentId station = frame.transmitter;
  const bool again = frame.type == FrameType::kReassociationRequest;
  const auto request = decode_association_request(*frame.payload, again);
  if (!request || request->bss.ssid != network_.bss.ssid) return;
  if (!authenticated_.contains(station)) {
    return answer(FrameType::kDeauthentication, station, encode_reason(kReasonNotAuthenticated));
  }
  forget(station);
  authenticated_.insert(station);
  AssociationResponse response{.bss = network_.bss, .status = kStatusTooManyStations};
  if (const auto id = free_association_id()) {
    offered_[station] = *id;
    response.status = kStatusSuccess;
    response.association_id = *id;
  }
  answer(again ? FrameType::kReassociationResponse : FrameType::kAssociationResponse, station,
         encode(response));
}

/// 11.3.5.3: a station is associated when it has acknowledged the response.
void AccessPoint::on_management_sent(const MacRequest& request, hal::Verdict verdict) {
  if (request.header.type == FrameType::kBeacon) {
    beacon_waits_ = false;
    return;
  }
  const bool is_response = request.header.type == FrameType::kAssociationResponse ||
                           request.header.type == FrameType::kReassociationResponse;
  if (!is_response) return;
  const auto offer = offered_.extract(request.destination);
  if (offer.empty() || verdict != hal::Verdict::kDelivered) return;
  associated_[request.destination] = offer.mapped();
  network_.distribution.associate(request.destination, agent());
  update_ht_operation();
}

void AccessPoint::on_moved(hal::AgentId station) {
  associated_.erase(station);
  update_ht_operation();
}

void AccessPoint::forget(hal::AgentId station) {
  authenticated_.erase(station);
  offered_.erase(station);
  if (associated_.erase(station) == 0) return;
  network_.distribution.release(station, agent());
  update_ht_operation();
}

/// Answers data of a station that is not associated (11.3.4.1).
void AccessPoint::dismiss(hal::AgentId station) {
  const bool known = authenticated_.contains(station);
  answer(known ? FrameType::kDisassociation : FrameType::kDeauthentication, station,
         encode_reason(kReasonNotAssociated));
}

void AccessPoint::on_data(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) {
  const MacRequest request{.destination = frame.destination(),
                           .ethertype = frame.ethertype,
                           .priority = frame.priority,
                           .payload = frame.payload,
                           .tag = 0,
                           .group = frame.group};
  if (!has(frame.source())) {
    lose_relay(frame.source(), request, hal::Verdict::kNoRoute);
    return dismiss(frame.source());
  }
  if (request.destination == hal::kEveryone) {
    relay(request, frame.source());
    network_.distribution.carry({request, frame.source(), rssi.value, snr.value}, agent());
    return deliver(frame, rssi, snr);
  }
  if (request.destination == agent()) return deliver(frame, rssi, snr);
  if (has(request.destination)) return relay(request, frame.source());
  const bool carried =
      network_.distribution.carry({request, frame.source(), rssi.value, snr.value}, agent());
  if (!carried) return lose_relay(frame.source(), request, hal::Verdict::kNoRoute);
  observer().on_msdu_end(now(), {agent(), frame.source(), request},
                         {.has_waited = false, .went_over_wire = true});
}

void AccessPoint::relay(const MacRequest& request, hal::AgentId source) {
  if (!queue_data({request, source, now()})) {
    lose_relay(source, request, hal::Verdict::kQueueFull);
  }
}

void AccessPoint::on_distributed(const Distributed& distributed) {
  const MacRequest& request = distributed.request;
  if (!radio_on()) {
    return lose_relay(distributed.source, request, hal::Verdict::kRadioOff);
  }
  if (request.destination != agent()) relay(request, distributed.source);
  if (request.destination == agent() || request.destination == hal::kEveryone) {
    deliver(request.ethertype, {.source = distributed.source,
                                .destination = request.destination,
                                .payload = request.payload,
                                .rssi_dbm = distributed.rssi_dbm,
                                .snr_db = distributed.snr_db,
                                .ethertype = request.ethertype,
                                .group = request.group});
  }
}

/// Its own group frames also go to the distribution system; frames for stations that are not
/// associated here go only there.
std::optional<MacRequest> AccessPoint::frame_for(const Waiting& waiting) {
  const hal::AgentId destination = waiting.request.destination;
  const Distributed distributed{waiting.request, waiting.source, network_.rssi_dbm,
                                network_.snr_db};
  if (destination == hal::kEveryone) {
    if (waiting.source == agent()) network_.distribution.carry(distributed, agent());
    return data_frame(waiting, destination, Ds::kFrom);
  }
  if (has(destination)) return data_frame(waiting, destination, Ds::kFrom);
  const bool carried = network_.distribution.carry(distributed, agent());
  Waiting left = waiting;
  left.over_wire = carried;
  end_later(std::move(left), carried ? hal::Verdict::kDelivered : hal::Verdict::kNoRoute);
  return std::nullopt;
}

}  // namespace sim::radio
