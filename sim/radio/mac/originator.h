#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hal/types/random.h"
#include "hal/types/time.h"
#include "sim/radio/mac/aggregation.h"
#include "sim/radio/mac/block_ack_action.h"
#include "sim/radio/mac/exchange.h"
#include "sim/radio/mac/frame_factory.h"
#include "sim/radio/mac/mpdu_stream.h"
#include "sim/radio/mac/msdu_queues.h"
#include "sim/radio/mac/ppdu.h"
#include "sim/radio/mac/protection.h"
#include "sim/radio/mac/retry.h"
#include "sim/radio/mac/tx_queue.h"
#include "sim/radio/rate/rate_control.h"
#include "sim/radio/rate/rate_ladder.h"

namespace sim::radio {

/// The originator of data and of Block Ack: the queues of a station, what its next exchange sends,
/// and what follows from the answer (IEEE Std 802.11-2020, 10.3.4.4, 10.23.2 and 10.25).
class Originator {
 public:
  struct Parts {
    const DcfConfig& config;
    const ModeSet& modes;
    const LengthsConfig& lengths;
    const Cell& cell;
    hal::AgentId agent;
    std::size_t functions;
    hal::RandomStream rates;  ///< Random numbers of the rate control.
    std::uint64_t flows;      ///< Seed of flow_hash().
    RadioObserver& observer;
  };
  /// @param frames  outlives this object, as do the parts.
  Originator(const Parts& parts, FrameFactory& frames);

  const Protection& protection() const { return protection_; }
  Protection& protection() { return protection_; }
  /// Function that sends a request.
  ContentionFunction function_of(const MacRequest& request) const;
  std::size_t room(ContentionFunction function) const;
  std::size_t waiting() const;
  void push(const MacRequest& request, hal::Time now);
  /// Queues a frame of the MAC itself before all others.
  void push_front(const MacRequest& request, hal::Time now);
  bool has_work(ContentionFunction function) const;

  /// The queues of data; null if they wait with everything else, first in, first out.
  MsduQueues* queues() const { return queues_.get(); }
  /// Adds the airtime of an exchange, or of a frame received, to the receiver's or the sender's.
  void charge(const Exchange& exchange);
  void charge(hal::AgentId sender, ContentionFunction function, hal::Duration airtime);

  /// What is left of a TXOP.
  struct Budget {
    hal::Duration left = hal::Duration::max();
    bool is_first = true;  ///< The exchange opens the TXOP: a single MPDU may exceed what is left.
  };
  /// Decides the next exchange of a function. @param ended  gets the requests that have expired.
  /// @return nullopt: nothing is to be sent, or nothing fits.
  std::optional<Exchange> next(ContentionFunction function, hal::Time now, const Budget& budget,
                               EndedMsdus& ended);
  /// Makes the PPDU of data, or of the BlockAckReq. @param after  duration of what follows it.
  PpduPtr make(const Exchange& exchange, hal::Duration after, hal::Time now);

  /// The receiver has sent its CTS.
  void on_cts(const Exchange& exchange) {
    retries_of(exchange).succeed(RetryCounters::Kind::kShort);
  }
  /// An ACK or a BlockAck was received; on_delivered() or on_block_ack() follows.
  void on_answer(const Exchange& exchange, const Frame& answer) {
    if (exchange.kind == Exchange::Kind::kBlockAckRequest) return;
    rates_->on_answer(exchange.to, answer.answered_snr, exchange.mode->width());
  }
  /// An ACK was received, or a group frame was sent.
  void on_delivered(const Exchange& exchange, hal::Time now, EndedMsdus& ended);
  void on_block_ack(const Exchange& exchange, const BlockAckFields& fields, hal::Time now,
                    EndedMsdus& ended);
  /// Nothing answered. @param was_data  the data were sent, not only an RTS.
  /// @return whether something was given up, after which the contention window starts anew.
  bool on_failure(const Exchange& exchange, bool was_data, hal::Time now, EndedMsdus& ended);
  /// The frame could have been sent but for a higher function. @return as above.
  bool on_internal_collision(ContentionFunction function, hal::Time now, EndedMsdus& ended);

  /// A receiver has answered a request for an agreement, or has ended one.
  void on_response(hal::AgentId from, const AddBlockAckResponse& response);
  void on_delete(hal::AgentId from, const DeleteBlockAck& del);

  /// Removes everything and forgets all agreements: the radio is switched off.
  EndedMsdus take_all(hal::Time now);

  /// Since when what the exchange sends has been the next to be sent.
  hal::Time service_since(const Exchange& exchange) const {
    return exchange.stream != nullptr ? exchange.stream->served_since
                                      : functions_[exchange.function].queue.head_since();
  }

 private:
  struct Function {
    TxQueue queue;
    RetryCounters retries;
    std::deque<MpduStream*> streams{};  ///< Those with MPDUs in flight; the first is served.
    bool had_head = false;              ///< The last exchange was to send the head of the queue.
  };
  using StreamKey = std::pair<hal::AgentId, std::uint8_t>;

  RetryCounters& retries_of(const Exchange& exchange) {
    return functions_[exchange.function].retries;
  }
  bool is_expired(const Outgoing& outgoing, hal::Time now) const;
  void discard_expired(Function& function, hal::Time now, EndedMsdus& ended);
  void discard_expired(MpduStream& stream, hal::Time now, EndedMsdus& ended);
  bool is_stream(const Outgoing& outgoing) const;
  bool is_in_service(const Function& function) const;
  MsduQueues::Name name_of(ContentionFunction function, hal::AgentId receiver) const;
  MpduStream* stream_for(const Function& function, hal::AgentId queue) const;
  std::optional<Exchange> next_turn(ContentionFunction function, hal::Time now,
                                    const Budget& budget, EndedMsdus& ended);
  bool resume(ContentionFunction function, MpduStream& stream, hal::Time now, EndedMsdus& ended);
  std::optional<Exchange> stream_turn(ContentionFunction function, MpduStream& stream,
                                      hal::Time now, const Budget& budget);
  std::optional<Exchange> head_turn(ContentionFunction function, hal::Time now,
                                    const Budget& budget);
  bool pop_more(ContentionFunction function, const MpduStream& stream, hal::Time now);
  void put_back(ContentionFunction function, hal::Time now);
  MpduStream& stream_of(const Outgoing& outgoing);
  bool request_agreement(MpduStream& stream, Function& function, hal::Time now);
  std::optional<Exchange> head_exchange(ContentionFunction function, hal::Time now,
                                        const Budget& budget);
  hal::Duration response_airtime(const Exchange& exchange) const;
  std::optional<Exchange> stream_exchange(ContentionFunction function, MpduStream& stream,
                                          hal::Time now, const Budget& budget);
  Exchange request_exchange(ContentionFunction function, MpduStream& stream, hal::Time now);
  PpduPtr make_head(const Exchange& exchange, hal::Duration after, hal::Time now);
  PpduPtr make_mpdus(const Exchange& exchange, hal::Duration after, hal::Time now);
  std::shared_ptr<Frame> make_mpdu(const Exchange& exchange, Mpdu& mpdu, hal::Duration after,
                                   hal::Time now);
  void settle(Function& function, MpduStream& stream);
  static void end(Mpdu& mpdu, hal::Verdict verdict, EndedMsdus& ended);
  void end_exchange(const Exchange& exchange, hal::Verdict verdict, hal::Time now,
                    EndedMsdus& ended);
  static void forget_agreement(MpduStream& stream);
  bool is_exchange_expired(const Exchange& exchange, hal::Time now) const;
  bool miss_block_ack(const Exchange& exchange, EndedMsdus& ended);
  bool has_rate_control(const Exchange& exchange) const;

  const DcfConfig& config_;
  const ModeSet& modes_;
  const LengthsConfig& lengths_;
  const Cell& cell_;
  hal::AgentId agent_;
  FrameFactory& frames_;
  RateLadders ladders_;
  std::unique_ptr<RateControl> rates_;
  Protection protection_;
  Aggregation aggregation_;
  std::vector<Function> functions_;
  std::unique_ptr<MsduQueues> queues_;
  std::map<StreamKey, MpduStream> streams_;
  std::uint32_t ampdus_ = 0;  ///< Number of A-MPDUs made.
  std::uint8_t dialogs_ = 0;  ///< Number of agreements asked for.
};

}  // namespace sim::radio
