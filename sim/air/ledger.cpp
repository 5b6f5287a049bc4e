#include "sim/air/ledger.h"

#include <algorithm>

#include "hal/rtps/submessage.h"

namespace sim::air {
namespace {

/// Number of incomplete datagrams remembered for each receiver.
constexpr std::size_t kMostArriving = 256;
constexpr std::int64_t kSecond = 1'000'000'000;
/// Longer than any propagation delay.
constexpr hal::Duration kPropagation = std::chrono::milliseconds{1};

ContentPtr of_kind(Purpose purpose, std::uint16_t what) {
  return std::make_shared<const Content>(
      Content{{Piece{.kind = {.purpose = purpose, .what = what}}}});
}

bool is_of_interface(radio::Ethertype type) {
  return type == kEthertypeIpv4 || type == kEthertypeArp || type == kEthertypeIpv6;
}

/// The agents that a group frame is for: in a BSS, stations associated with its access point.
Samples::Whom whom_of(const radio::Frame& frame) {
  Samples::Whom whom{.destination = hal::kEveryone};
  if (frame.ds == radio::Ds::kFrom) whom.access_point = frame.transmitter;
  return whom;
}

SampleLoss loss_of(hal::Verdict verdict, hal::AgentId at, std::uint64_t frame) {
  return {.cause = {.kind = LossCause::Kind::kVerdict, .verdict = verdict, .at = at},
          .frame = frame};
}

/// Visits the samples that lie at least partly in a frame.
template <class Act>
void for_samples(const Content& content, const Act& act) {
  for (const ContentPtr& msdu : content.msdus) for_samples(*msdu, act);
  const DatagramPlace& place = content.place;
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
  if (frame.amsdu) return content_of_amsdu(at, *frame.amsdu);
  return content_of(at, {.source = frame.source(),
                         .destination = frame.destination(),
                         .ethertype = frame.ethertype,
                         .payload = frame.payload});
}

ContentPtr Ledger::content_of(hal::Time at, const radio::AmsduPart& msdu) {
  if (msdu.ethertype == radio::kEthertypeRouting) return of_types_.front();
  if (!is_of_interface(msdu.ethertype)) return of_kind(Purpose::kOther, msdu.ethertype);
  return read(at, msdu.source, msdu.destination, msdu.payload, msdu.ethertype);
}

/// Divides the A-MSDU by the lengths of its subframes, and each of these among its own pieces.
ContentPtr Ledger::content_of_amsdu(hal::Time at, const std::vector<radio::AmsduPart>& msdus) {
  constexpr std::size_t kHeaders = 14 + 8;  // subframe header and LLC/SNAP
  auto whole = std::make_shared<Content>();
  std::vector<std::int64_t> octets;
  for (const radio::AmsduPart& msdu : msdus) {
    ContentPtr content = content_of(at, msdu);
    share_out(static_cast<std::int64_t>(kHeaders + msdu.payload->size()), content->pieces, octets);
    for (std::size_t i = 0; i < octets.size(); ++i) {
      Piece& piece = whole->pieces.emplace_back(content->pieces[i]);
      piece.octets = static_cast<std::uint32_t>(octets[i]);
    }
    whole->msdus.push_back(std::move(content));
  }
  return whole;
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
  Sent& last = station.sent[station.last];
  return last.frame == frame.id ? &last : station.find(frame.id);
}

void Ledger::on_frame_start(hal::Time at, const radio::Frame& frame) {
  if (frame.transmitter.value >= stations_.size())
    stations_.resize(frame.transmitter.value + std::size_t{1});
  Station& station = stations_[frame.transmitter.value];
  ContentPtr content = content_of(at, frame);
  Sent& sent = station.place_for(frame);
  const Sent& before = station.sent[(station.last - 1) & (station.sent.size() - 1)];
  if (before.content == content) {
    sent.shares = before.shares;
  } else if (sent.content != content) {
    accounts_.open(*content, frame.transmitter, sent.shares);
  }
  sent.frame = frame.id;
  sent.ampdu = frame.ampdu;
  sent.start = at;
  sent.before = frame.airtime_before;
  sent.airtime = frame.airtime;
  sent.content = std::move(content);
  accounts_.add(*sent.content, {frame.transmitter, frame.retry, frame.air_length, frame.airtime},
                sent.shares);
  count_second(at, sent, 1);
  if (frame.is_broadcast()) return on_group_frame(at, frame, sent);
  if (frame.type == radio::FrameType::kRts) station.rts = {frame.id, frame.receiver};
  if (frame.type != radio::FrameType::kData) return;
  if (!frame.amsdu) return station.on_attempt(frame, frame.payload.get());
  for (const radio::AmsduPart& msdu : *frame.amsdu) station.on_attempt(frame, msdu.payload.get());
}

void Ledger::on_group_frame(hal::Time at, const radio::Frame& frame, const Sent& sent) {
  const SampleLoss unnoticed =
      loss_of(hal::Verdict::kBelowSensitivity, frame.transmitter, frame.id);
  for_samples(*sent.content, [&](const DatagramPart& part) {
    samples_.on_group_frame(part, whom_of(frame), unnoticed, at + frame.airtime + kPropagation);
  });
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
  shorten(*sent, at);
}

/// The PPDU of a frame ends earlier than it was to.
void Ledger::shorten(Sent& sent, hal::Time end) {
  count_second(sent.start, sent, -1);
  sent.airtime = std::clamp(end - sent.start - sent.before, hal::Duration{}, sent.airtime);
  accounts_.cut(*sent.content, sent.airtime, sent.shares);
  count_second(sent.start, sent, 1);
}

void Ledger::on_reception(hal::Time, const radio::Frame& frame, hal::AgentId receiver,
                          hal::Verdict verdict, double) {
  const Sent* const sent = find(frame);
  if (sent == nullptr) return;
  const bool addressed = frame.is_broadcast() || frame.receiver == receiver;
  accounts_.add_end(*sent->content, sent->shares, receiver, addressed, verdict);
  if (!addressed) return;
  if (!frame.is_broadcast())
    return stations_[frame.transmitter.value].on_attempt_end(frame, verdict);
  on_group_frame_end(frame, *sent, receiver, verdict);
}

void Ledger::on_group_frame_end(const radio::Frame& frame, const Sent& sent, hal::AgentId receiver,
                                hal::Verdict verdict) {
  Samples::Whom whom = whom_of(frame);
  if (!samples_.is_for(whom, receiver)) return;
  whom.destination = receiver;
  std::optional<SampleLoss> loss;
  if (verdict != hal::Verdict::kDelivered) loss = loss_of(verdict, frame.transmitter, frame.id);
  for_samples(*sent.content, [&](const DatagramPart& part) {
    samples_.on_group_frame_end(part, whom, frame.id, loss);
  });
}

/// Takes the transmissions of an MSDU that has ended.
Ledger::Attempts Ledger::take_attempts(const radio::Msdu& msdu, const radio::MsduEnd& end) {
  if (msdu.station.value >= stations_.size() || !end.has_waited || end.went_over_wire) return {};
  const bool was_served =
      end.verdict == hal::Verdict::kDelivered || end.verdict == hal::Verdict::kRetryLimit;
  return stations_[msdu.station.value].take(msdu.request.payload.get(), was_served);
}

void Ledger::on_msdu_end(hal::Time at, const radio::Msdu& msdu, const radio::MsduEnd& end) {
  const Attempts attempts = take_attempts(msdu, end);
  if (end.verdict == hal::Verdict::kDelivered || attempts.has_arrived) return;
  if (!is_of_interface(msdu.request.ethertype)) return;
  hal::Verdict verdict = end.verdict;
  if (verdict == hal::Verdict::kRetryLimit && attempts.last.frame != 0) {
    const hal::Verdict last = attempts.last.verdict.value_or(hal::Verdict::kBelowSensitivity);
    // Otherwise the RTS was received, but not its CTS.
    if (last != hal::Verdict::kDelivered) verdict = last;
  }
  const SampleLoss loss = loss_of(verdict, msdu.station, attempts.last.frame);
  Samples::Whom whom{.destination = msdu.request.destination};
  // An MSDU without a route ends before it is relayed.
  const bool is_passed_on = msdu.station != msdu.source && verdict != hal::Verdict::kNoRoute;
  if (is_passed_on) whom.access_point = msdu.station;
  const ContentPtr content =
      read(at, msdu.source, msdu.request.destination, msdu.request.payload, msdu.request.ethertype);
  for_samples(*content, [&](const DatagramPart& part) { samples_.on_lost(part, whom, loss); });
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
    const bool is_data = part.kind.what == static_cast<int>(hal::rtps::SubmessageKind::kData);
    if (part.kind.purpose == Purpose::kSpdp && is_data)
      endpoints_.meet(endpoints_.all()[part.writer].guid.prefix, agent);
    if (part.told != 0) endpoints_.reach(part.told, part.writer, agent);
  }
}

void Ledger::finish(hal::Time now) {
  for (Station& station : stations_) {
    const std::uint64_t newest = station.sent[station.last].frame;
    const std::uint32_t ampdu = station.sent[station.last].ampdu;
    for (Sent& sent : station.sent) {
      const bool is_of_last = sent.frame == newest || (ampdu != 0 && sent.ampdu == ampdu);
      if (sent.frame == 0 || !is_of_last) continue;
      if (sent.start + sent.before + sent.airtime > now) shorten(sent, now);
    }
  }
  samples_.finish(now);
  if (on_second_ && !second_.airtime.empty()) on_second_(second_);
  second_ = {};
}

}  // namespace sim::air
