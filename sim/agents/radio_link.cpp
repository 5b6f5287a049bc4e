#include "sim/agents/radio_link.h"

#include <memory>
#include <utility>

namespace sim::agents {

RadioLink::RadioLink(radio::MacSap& mac, LinkKind kind) : mac_(mac), kind_(kind) {
  mac_.add_client(radio::kEthertypeRouting, *this);
}

hal::node::routing::LinkCapabilities RadioLink::capabilities() const {
  if (kind_ == LinkKind::kUdpLike) return {.tx_status = false, .rssi = false};
  const radio::MacCapabilities mac = mac_.capabilities();
  return {.tx_status = mac.tx_status, .rssi = mac.rssi};
}

void RadioLink::transmit(hal::AgentId next_hop, hal::Bytes frame,
                         const hal::node::routing::LinkOptions& options) {
  mac_.transmit({.destination = next_hop,
                 .ethertype = radio::kEthertypeRouting,
                 .priority = hal::to_number(options.priority),
                 .payload = std::make_shared<const hal::Bytes>(std::move(frame)),
                 .tag = options.tag});
}

void RadioLink::set_radio(bool on) {
  is_wanted_ = on;
  mac_.set_radio(is_wanted_ && has_power_ && !is_empty_);
}

void RadioLink::set_power(bool on) {
  has_power_ = on;
  set_radio(is_wanted_);
}

void RadioLink::cut_power() {
  is_empty_ = true;
  set_radio(is_wanted_);
}

void RadioLink::on_receive(const radio::MacIndication& indication) {
  hal::node::routing::Reception reception{.from = indication.source};
  if (kind_ == LinkKind::kMac) {
    reception.rssi_dbm = indication.rssi_dbm;
    reception.snr_db = indication.snr_db;
  }
  router_->on_frame(reception, *indication.payload);
}

void RadioLink::on_transmitted(std::uint64_t tag, hal::Verdict verdict) {
  if (kind_ == LinkKind::kUdpLike) return;
  router_->on_transmitted({.tag = tag, .verdict = verdict});
}

}  // namespace sim::agents
