#include "sim/radio/mac/mac_base.h"

#include <algorithm>
#include <memory>

#include "hal/types/check.h"
#include "sim/radio/mac/frame_lengths.h"

namespace sim::radio {

MacBase::MacBase(const Context& context)
    : events_(context.events),
      observer_(context.observer),
      modes_(context.modes),
      lengths_(context.lengths),
      tx_power_(context.tx_power),
      agent_(context.agent),
      cell_(context.cell),
      service_time_(modes_.data().airtime(mpdu_bits(lengths_, FrameType::kData))) {}

void MacBase::add_client(Ethertype ethertype, MacClient& client) {
  BARAKA_CHECK(client_of(ethertype) == nullptr);
  if (clients_.empty()) first_client_ = {ethertype, &client};
  clients_.emplace_back(ethertype, &client);
}

MacClient* MacBase::client_of(Ethertype ethertype) const {
  if (first_client_.first == ethertype) return first_client_.second;
  const auto found = std::find_if(clients_.begin(), clients_.end(), [ethertype](const auto& entry) {
    return entry.first == ethertype;
  });
  return found == clients_.end() ? nullptr : found->second;
}

void MacBase::check(const MacRequest& request) const {
  BARAKA_CHECK(request.payload != nullptr && request.payload->size() <= kMaxMsdu);
  BARAKA_CHECK(request.destination != agent_);
  BARAKA_CHECK(listener_ != nullptr || client_of(request.ethertype) != nullptr);
}

void MacBase::hand_up(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) {
  if (listener_ != nullptr) return listener_->on_frame(frame, rssi, snr);
  if (!frame.is_of_bss()) deliver(frame, rssi, snr);
}

void MacBase::deliver(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) {
  MacClient* const client = client_of(frame.ethertype);
  if (client == nullptr) return;
  __builtin_prefetch(client);
  observer_.on_delivered(now(), frame, agent_);
  client->on_receive({.source = frame.source(),
                      .destination = frame.destination(),
                      .payload = frame.payload,
                      .rssi_dbm = rssi.value,
                      .snr_db = snr.value,
                      .ethertype = frame.ethertype,
                      .group = frame.group});
}

void MacBase::deliver(Ethertype ethertype, const MacIndication& indication) {
  if (MacClient* const client = client_of(ethertype)) client->on_receive(indication);
}

void MacBase::report(const MacRequest& request, hal::Verdict verdict) {
  if (listener_ != nullptr) return listener_->on_sent(request, verdict);
  observer_.on_msdu_end(now(), {agent_, agent_, request}, {.verdict = verdict});
  observer_.on_request_end(now(), agent_, request.destination, verdict);
  client_of(request.ethertype)->on_transmitted(request.tag, verdict);
}

void MacBase::report_later(MacRequest request, hal::Verdict verdict) {
  auto shared = std::make_shared<const MacRequest>(std::move(request));
  events_.schedule(now(), Rank::kRadio, agent_,
                   [this, shared, verdict] { report(*shared, verdict); });
}

void MacBase::learn_service_time(hal::Duration took) {
  service_time_ = (7 * service_time_ + 3 * took) / 10;
}

hal::Duration MacBase::expected_delay() const {
  return (static_cast<std::int64_t>(queued()) + 1) * service_time_;
}

double MacBase::transmit_energy(std::size_t bytes) const {
  const hal::Duration time = modes_.data().airtime(mpdu_bits(lengths_, FrameType::kData, bytes));
  return tx_power_.value * 1e-3 * hal::to_seconds(time);
}

}  // namespace sim::radio
