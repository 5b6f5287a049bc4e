// The frames that an originator sends.
#include "sim/radio/mac/frame_lengths.h"
#include "sim/radio/mac/originator.h"

namespace sim::radio {

PpduPtr Originator::make(const Exchange& exchange, hal::Duration after, hal::Time now) {
  switch (exchange.kind) {
    case Exchange::Kind::kHead:
      return make_head(exchange, after, now);
    case Exchange::Kind::kAggregate:
      return make_mpdus(exchange, after, now);
    case Exchange::Kind::kBlockAckRequest:
      break;
  }
  const BlockAckFields fields{.tid = exchange.stream->tid, .start = exchange.stream->start()};
  return ppdu_of(frames_.block_ack_request(exchange.to, fields, after, *exchange.mode));
}

PpduPtr Originator::make_head(const Exchange& exchange, hal::Duration after, hal::Time now) {
  Outgoing& head = functions_[exchange.function].queue.head();
  const bool retry = head.attempts++ > 0;
  return ppdu_of(frames_.data(head.request, {.sequence = head.sequence,
                                             .retry = retry,
                                             .duration = after,
                                             .mode = exchange.mode,
                                             .at = now}));
}

PpduPtr Originator::make_mpdus(const Exchange& exchange, hal::Duration after, hal::Time now) {
  std::deque<Mpdu>& mpdus = exchange.stream->in_flight;
  if (exchange.mpdus == 1) {
    auto single = std::make_shared<Ppdu>(*exchange.mode, exchange.bits);
    std::shared_ptr<Frame> frame = make_mpdu(exchange, mpdus.front(), after, now);
    frame->airtime = single->airtime;
    single->parts.push_back({std::move(frame), 0, exchange.bits});
    return single;
  }
  ++ampdus_;
  auto ppdu = std::make_shared<Ppdu>(*exchange.mode, exchange.bits);
  const hal::Duration head = exchange.mode->preamble_and_header();
  const auto sent_until = [&](std::uint32_t bit) {
    const double share = static_cast<double>(bit) / exchange.bits;
    return head + hal::Duration{static_cast<std::int64_t>(
                      static_cast<double>((ppdu->airtime - head).count()) * share)};
  };
  hal::Duration sent{};
  for (std::uint32_t i = 0, bits = 0; i < exchange.mpdus; ++i) {
    const std::uint32_t begin = Aggregation::subframe_begin(bits);
    bits = Aggregation::with_subframe(bits, mpdus[i].bits);
    std::shared_ptr<Frame> frame = make_mpdu(exchange, mpdus[i], after, now);
    frame->ampdu = ampdus_;
    frame->is_last_of_ampdu = i + 1 == exchange.mpdus;
    frame->airtime = (frame->is_last_of_ampdu ? ppdu->airtime : sent_until(bits)) - sent;
    frame->airtime_before = sent;
    frame->airtime_of_all = ppdu->airtime;
    sent += frame->airtime;
    ppdu->parts.push_back({std::move(frame), begin, bits});
  }
  return ppdu;
}

std::shared_ptr<Frame> Originator::make_mpdu(const Exchange& exchange, Mpdu& mpdu,
                                             hal::Duration after, hal::Time now) {
  const bool retry = mpdu.attempts++ > 0;
  auto frame = frames_.data(mpdu.msdus.front().request, {.sequence = mpdu.sequence,
                                                         .retry = retry,
                                                         .duration = after,
                                                         .mode = exchange.mode,
                                                         .at = now,
                                                         .qos = true,
                                                         .bits = mpdu.bits});
  if (mpdu.msdus.size() == 1) return frame;
  auto parts = std::make_shared<std::vector<AmsduPart>>();
  for (const Outgoing& msdu : mpdu.msdus) {
    const MacRequest& request = msdu.request;
    parts->push_back({.source = request.header.ds == Ds::kFrom ? request.header.address3 : agent_,
                      .destination = request.header.ds == Ds::kTo ? request.header.address3
                                                                  : request.destination,
                      .ethertype = request.ethertype,
                      .payload = request.payload,
                      .tag = request.tag});
  }
  frame->amsdu = std::move(parts);
  return frame;
}

}  // namespace sim::radio
