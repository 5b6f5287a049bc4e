#include "sim/air/ledger.h"

#include <algorithm>

namespace sim::air {
namespace {

/// Datagrams that stay incomplete at a receiver: the last so many are remembered.
constexpr std::size_t kMostArriving = 256;
constexpr std::int64_t kSecond = 1'000'000'000;

ContentPtr of_kind(Purpose purpose, std::uint16_t what) {
  return std::make_shared<const Content>(
      Content{{Piece{.kind = {.purpose = purpose, .what = what}}}});
}

bool is_of_interface(radio::Ethertype type) {
  return type == kEthertypeIpv4 || type == kEthertypeArp || type == kEthertypeIpv6;
}

/// Samples that lie in a frame, whole or in part.
template <class Act>
void for_samples(const DatagramPlace& place, const Act& act) {
  if (!place.datagram) return;
  for (const DatagramPart& part : place.datagram->parts) {
    if (part.has_sample() && part.begin < place.end && place.begin < part.end) act(part);
  }
}

}  // namespace

Ledger::Ledger() {
  of_types_.push_back(of_kind(Purpose::kRouting, radio::kEthertypeRouting));
  for (int i = 1; i < radio::kFrameTypes; ++i)
    of_types_.push_back(of_kind(Purpose::kMac, static_cast<std::uint16_t>(i)));
}

ContentPtr Ledger::content_of(hal::Time at, const radio::Frame& frame) {
  if (frame.type != radio::FrameType::kData) return of_types_[static_cast<std::size_t>(frame.type)];
  if (frame.ethertype == radio::kEthertypeRouting) return of_types_.front();
  if (!is_of_interface(frame.ethertype)) return of_kind(Purpose::kOther, frame.ethertype);
  return read(at, frame.source(), frame.destination(), frame.payload, frame.ethertype);
}

ContentPtr Ledger::read(hal::Time at, hal::AgentId source, hal::AgentId destination,
                        const radio::Payload& payload, radio::Ethertype type) {
  const Contents::Read read = contents_.read(at, source, type, payload);
  const Datagram* const datagram = read.content->place.datagram.get();
  if (!read.is_new || datagram == nullptr) return read.content;
  for (std::size_t i = read.first_new_part; i < datagram->parts.size(); ++i) {
    if (datagram->parts[i].has_sample())
      samples_.on_sent(at, *datagram, datagram->parts[i], destination);
  }
  return read.content;
}

void Ledger::on_entered(hal::Time at, hal::AgentId agent, const radio::MacRequest& request) {
  if (is_of_interface(request.ethertype))
    read(at, agent, request.destination, request.payload, request.ethertype);
}

Ledger::Sent* Ledger::find(const radio::Frame& frame) {
  if (frame.transmitter.value >= stations_.size()) return nullptr;
  Station& station = stations_[frame.transmitter.value];
  const auto found = std::ranges::find(station.sent, frame.id, &Sent::frame);
  return found == station.sent.end() ? nullptr : &*found;
}

void Ledger::on_frame_start(hal::Time at, const radio::Frame& frame) {
  if (frame.transmitter.value >= stations_.size())
    stations_.resize(frame.transmitter.value + std::size_t{1});
  Station& station = stations_[frame.transmitter.value];
  ContentPtr content = content_of(at, frame);
  const Sent& before = station.sent[station.last];
  station.last = (station.last + 1) % kRemembered;
  Sent& sent = station.sent[station.last];
  if (before.content == content) {
    sent.shares = before.shares;
  } else if (sent.content != content) {
    accounts_.open(*content, frame.transmitter, sent.shares);
  }
  sent.frame = frame.id;
  sent.start = at;
  sent.airtime = frame.airtime;
  sent.content = std::move(content);
  accounts_.add(*sent.content, {frame.transmitter, frame.retry, frame.air_length, frame.airtime},
                sent.shares);
  count_second(at, sent, 1);
  for_samples(sent.content->place, [this](const DatagramPart& part) { samples_.on_started(part); });
}

void Ledger::count_second(hal::Time at, const Sent& sent, int sign) {
  const std::int64_t second = hal::to_ns(at) / kSecond;
  if (second > second_.second) {
    if (on_second_ && !second_.airtime.empty()) on_second_(second_);
    second_ = {.second = second};
    samples_.settle(at);
  }
  for (std::size_t i = 0; i < sent.shares.size(); ++i) {
    const AirKind& kind = sent.content->pieces[i].kind;
    second_.airtime[{kind.purpose, kind.what}] += hal::Duration{sign * sent.shares[i].airtime_ns};
  }
}

void Ledger::on_frame_cut(hal::Time at, const radio::Frame& frame) {
  Sent* const sent = find(frame);
  if (sent == nullptr) return;
  count_second(sent->start, *sent, -1);
  sent->airtime = at - sent->start;
  accounts_.cut(*sent->content, sent->airtime, sent->shares);
  count_second(sent->start, *sent, 1);
}

void Ledger::on_reception(hal::Time, const radio::Frame& frame, hal::AgentId receiver,
                          hal::Verdict verdict, double) {
  const Sent* const sent = find(frame);
  if (sent == nullptr) return;
  const bool addressed = frame.is_broadcast() || frame.receiver == receiver;
  accounts_.add_end(*sent->content, sent->shares, receiver, addressed, verdict);
  if (!addressed || verdict == hal::Verdict::kDelivered) return;
  // On its way to an access point it is lost for whom it was meant.
  const hal::AgentId meant = frame.is_broadcast() ? receiver : frame.destination();
  for_samples(sent->content->place,
              [&](const DatagramPart& part) { samples_.on_lost(part, meant, verdict, frame.id); });
}

void Ledger::on_request_end(hal::Time, hal::AgentId sender, hal::AgentId, hal::Verdict verdict) {
  const bool was_sent = verdict == hal::Verdict::kDelivered || verdict == hal::Verdict::kRetryLimit;
  if (!was_sent) samples_.on_refused(sender, verdict);
}

void Ledger::on_left(hal::Time at, hal::AgentId agent, const radio::MacIndication& indication) {
  if (!is_of_interface(indication.ethertype)) return;
  const ContentPtr content =
      read(at, indication.source, indication.destination, indication.payload, indication.ethertype);
  const DatagramPlace& place = content->place;
  if (place.datagram && complete(agent, place)) on_whole(at, agent, *place.datagram);
}

bool Ledger::complete(hal::AgentId agent, const DatagramPlace& place) {
  if (place.begin == 0 && place.end == place.datagram->size) return true;
  std::vector<Arriving>& arriving = arriving_[agent];
  auto found = std::ranges::find(arriving, place.datagram, &Arriving::datagram);
  if (found == arriving.end()) {
    if (arriving.size() >= kMostArriving) arriving.erase(arriving.begin());
    found = arriving.insert(arriving.end(), {.datagram = place.datagram, .begins = {}});
  }
  if (std::ranges::find(found->begins, place.begin) != found->begins.end()) return false;
  found->begins.push_back(place.begin);
  found->octets += place.end - place.begin;
  if (found->octets < place.datagram->size) return false;
  arriving.erase(found);
  return true;
}

void Ledger::on_whole(hal::Time at, hal::AgentId agent, const Datagram& datagram) {
  for (const DatagramPart& part : datagram.parts) {
    if (part.has_sample()) samples_.on_received(at, datagram, part, agent);
    if (part.told != 0) endpoints_.reach(part.told, agent);
  }
}

void Ledger::finish(hal::Time now) {
  for (Station& station : stations_) {
    Sent& sent = station.sent[station.last];
    if (sent.frame == 0 || sent.start + sent.airtime <= now) continue;
    count_second(sent.start, sent, -1);
    sent.airtime = now - sent.start;
    accounts_.cut(*sent.content, sent.airtime, sent.shares);
    count_second(sent.start, sent, 1);
  }
  samples_.finish(now);
  if (on_second_ && !second_.airtime.empty()) on_second_(second_);
  second_ = {};
}

}  // namespace sim::air
