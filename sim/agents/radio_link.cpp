#include "sim/agents/radio_link.h"

#include <memory>
#include <utility>

namespace sim::agents {

RadioLink::RadioLink(radio::MacSap& mac) : mac_(mac) {
  mac_.add_client(radio::kEthertypeRouting, *this);
}

hal::routing::LinkCapabilities RadioLink::capabilities() const {
  const radio::MacCapabilities mac = mac_.capabilities();
  return {.tx_status = mac.tx_status, .rssi = mac.rssi};
}

void RadioLink::transmit(hal::AgentId next_hop, hal::Bytes frame, hal::routing::LinkTag tag) {
  mac_.transmit({.destination = next_hop,
                 .ethertype = radio::kEthertypeRouting,
                 .priority = 0,
                 .payload = std::make_shared<const hal::Bytes>(std::move(frame)),
                 .tag = tag});
}

void RadioLink::on_receive(const radio::MacIndication& indication) {
  router_->on_frame(
      {.from = indication.source, .rssi_dbm = indication.rssi_dbm, .snr_db = indication.snr_db},
      *indication.payload);
}

void RadioLink::on_transmitted(std::uint64_t tag, hal::Verdict verdict) {
  router_->on_transmitted({.tag = tag, .verdict = verdict});
}

}  // namespace sim::agents
