// What follows for an originator from the end of an exchange.
#include <algorithm>
#include <utility>

#include "sim/radio/mac/lifetime.h"
#include "sim/radio/mac/originator.h"

namespace sim::radio {

/// Whether rate control chooses the mode: of unicast data.
bool Originator::has_rate_control(const Exchange& exchange) const {
  if (exchange.kind == Exchange::Kind::kHead) {
    const Outgoing& head = functions_[exchange.function].queue.head();
    return !head.is_broadcast() && !head.is_management();
  }
  return exchange.kind == Exchange::Kind::kAggregate;
}

void Originator::end(Mpdu& mpdu, hal::Verdict verdict, EndedMsdus& ended) {
  for (Outgoing& msdu : mpdu.msdus) ended.push_back({std::move(msdu.request), verdict});
}

/// A stream without anything in flight leaves the medium to the head of the queue.
void Originator::settle(Function& function, MpduStream& stream) {
  if (!stream.in_flight.empty() || stream.must_ask) return;
  std::erase(function.streams, &stream);
}

/// Ends what the exchange was to send: the head of the queue, or the MPDUs.
void Originator::end_exchange(const Exchange& exchange, hal::Verdict verdict, hal::Time now,
                              EndedMsdus& ended) {
  Function& function = functions_[exchange.function];
  function.retries.reset();
  if (exchange.kind == Exchange::Kind::kHead) {
    ended.push_back({function.queue.pop(now), verdict});
    return;
  }
  MpduStream& stream = *exchange.stream;
  stream.served_since = now;
  for (std::uint32_t i = 0; i < exchange.mpdus; ++i) {
    end(stream.in_flight.front(), verdict, ended);
    stream.in_flight.pop_front();
  }
  // Without being told, the receiver would wait for an MPDU that was given up.
  const bool is_lost = verdict != hal::Verdict::kDelivered;
  stream.must_ask = is_lost && stream.agreement == MpduStream::Agreement::kActive;
  settle(function, stream);
}

/// Gives up MPDUs whose time is over; the receiver is told.
void Originator::discard_expired(MpduStream& stream, hal::Time now, EndedMsdus& ended) {
  if (!lifetime_of(config_, stream.tid)) return;
  std::deque<Mpdu> left;
  for (Mpdu& mpdu : stream.in_flight) {
    if (is_expired(mpdu.msdus.front(), now)) {
      end(mpdu, hal::Verdict::kExpired, ended);
      stream.must_ask = stream.agreement == MpduStream::Agreement::kActive;
    } else {
      left.push_back(std::move(mpdu));
    }
  }
  stream.in_flight = std::move(left);
}

void Originator::on_delivered(const Exchange& exchange, hal::Time now, EndedMsdus& ended) {
  if (!exchange.is_group() && has_rate_control(exchange)) rates_->on_result(exchange.to, true);
  end_exchange(exchange, hal::Verdict::kDelivered, now, ended);
}

void Originator::on_block_ack(const Exchange& exchange, const BlockAckFields& fields, hal::Time now,
                              EndedMsdus& ended) {
  Function& function = functions_[exchange.function];
  MpduStream& stream = *exchange.stream;
  stream.must_ask = false;
  stream.asked = 0;
  stream.served_since = now;
  function.retries.reset();
  const bool is_data = exchange.kind == Exchange::Kind::kAggregate;
  std::uint32_t sent = 0, arrived = 0;
  std::deque<Mpdu> left;
  for (Mpdu& mpdu : stream.in_flight) {
    const std::uint32_t bit = steps(fields.start, mpdu.sequence);
    const bool is_acknowledged = bit < fields.length && fields.received[bit];
    const bool is_part = is_data ? sent < exchange.mpdus : mpdu.attempts > 0;
    if (is_part) ++sent;
    if (is_acknowledged) {
      ++arrived;
      end(mpdu, hal::Verdict::kDelivered, ended);
    } else if (is_part && mpdu.attempts >= config_.contention.short_retry_limit) {
      end(mpdu, hal::Verdict::kRetryLimit, ended);
      stream.must_ask = true;  // the receiver must not wait for it
    } else {
      left.push_back(std::move(mpdu));
    }
  }
  stream.in_flight = std::move(left);
  if (is_data) rates_->on_aggregate(exchange.to, arrived, sent);
  settle(function, stream);
}

/// Nothing is known of MPDUs whose BlockAck is missing: the receiver is asked (10.25.7).
/// @return whether they were given up.
bool Originator::miss_block_ack(const Exchange& exchange, EndedMsdus& ended) {
  MpduStream& stream = *exchange.stream;
  stream.must_ask = stream.agreement == MpduStream::Agreement::kActive;
  if (exchange.kind == Exchange::Kind::kAggregate) {
    rates_->on_aggregate(exchange.to, 0, exchange.mpdus);
    return false;
  }
  if (!stream.must_ask) {  // the receiver has ended the agreement
    settle(functions_[exchange.function], stream);
    return false;
  }
  if (++stream.asked < config_.contention.short_retry_limit) return false;
  stream.asked = 0;
  stream.must_ask = false;
  while (!stream.in_flight.empty() && stream.in_flight.front().attempts > 0) {
    end(stream.in_flight.front(), hal::Verdict::kRetryLimit, ended);
    stream.in_flight.pop_front();
  }
  settle(functions_[exchange.function], stream);
  return true;
}

bool Originator::is_exchange_expired(const Exchange& exchange, hal::Time now) const {
  if (exchange.kind == Exchange::Kind::kHead) {
    return is_expired(functions_[exchange.function].queue.head(), now);
  }
  return is_expired(exchange.stream->in_flight.front().msdus.front(), now);
}

bool Originator::on_failure(const Exchange& exchange, bool was_data, hal::Time now,
                            EndedMsdus& ended) {
  if (was_data && exchange.has_block_ack()) return miss_block_ack(exchange, ended);
  // An RTS without a response says nothing about the rate of data.
  if (was_data && has_rate_control(exchange)) rates_->on_result(exchange.to, false);
  const bool after_rts = was_data && exchange.opening == Opening::kRts;
  const auto kind = after_rts ? RetryCounters::Kind::kLong : RetryCounters::Kind::kShort;
  const bool is_last = retries_of(exchange).fail(kind);
  if (!is_last && !is_exchange_expired(exchange, now)) return false;
  end_exchange(exchange, is_last ? hal::Verdict::kRetryLimit : hal::Verdict::kExpired, now, ended);
  return true;
}

bool Originator::on_internal_collision(ContentionFunction number, hal::Time now,
                                       EndedMsdus& ended) {
  Function& function = functions_[number];
  if (!function.retries.fail(RetryCounters::Kind::kShort)) return false;
  function.retries.reset();
  if (function.streams.empty()) {
    if (function.queue.is_empty()) return true;
    ended.push_back({function.queue.pop(now), hal::Verdict::kRetryLimit});
    return true;
  }
  MpduStream& stream = *function.streams.front();
  if (stream.in_flight.empty()) return true;
  end(stream.in_flight.front(), hal::Verdict::kRetryLimit, ended);
  stream.in_flight.pop_front();
  stream.must_ask = stream.agreement == MpduStream::Agreement::kActive;
  settle(function, stream);
  return true;
}

void Originator::on_response(hal::AgentId from, const AddBlockAckResponse& response) {
  const auto found = streams_.find({from, response.tid});
  if (found == streams_.end()) return;
  MpduStream& stream = found->second;
  if (stream.agreement != MpduStream::Agreement::kRequested) return;
  const bool is_accepted = response.status == 0;
  stream.agreement = is_accepted ? MpduStream::Agreement::kActive : MpduStream::Agreement::kNone;
  if (is_accepted) {
    stream.window = std::min(response.window, config_.aggregation.block_ack_window);
  }
}

void Originator::on_delete(hal::AgentId from, const DeleteBlockAck& del) {
  const auto found = streams_.find({from, del.tid});
  if (found == streams_.end()) return;
  forget_agreement(found->second);
}

void Originator::forget_agreement(MpduStream& stream) {
  stream.agreement = MpduStream::Agreement::kNone;
  stream.window = 1;
  stream.must_ask = false;
  stream.asked = 0;
}

}  // namespace sim::radio
