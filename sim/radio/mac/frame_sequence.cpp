#include "sim/radio/mac/frame_sequence.h"

#include <utility>

#include "sim/radio/mac/frame_lengths.h"

namespace sim::radio {

FrameSequence::FrameSequence(const Parts& parts, FrameFactory& frames, Originator& originator,
                             FrameSequenceListener& listener)
    : events_(parts.events),
      radio_(parts.radio),
      carrier_(parts.carrier),
      modes_(parts.modes),
      frames_(frames),
      originator_(originator),
      listener_(listener) {}

bool FrameSequence::is_answer(const Frame& frame) const {
  if (!awaiting_ || frame.receiver != radio_.agent()) return false;
  if (state_ == State::kWaitCts) return frame.type == FrameType::kCts;
  if (state_ != State::kWaitAnswer) return false;
  return frame.type == (exchange_.has_block_ack() ? FrameType::kBlockAck : FrameType::kAck);
}

void FrameSequence::start(const Exchange& exchange) {
  exchange_ = exchange;
  open();
}

void FrameSequence::start_after_sifs(const Exchange& exchange) {
  exchange_ = exchange;
  state_ = State::kTxop;
  carrier_.begin_exchange();
  events_.cancel(sifs_);
  sifs_ = events_.schedule(events_.now() + timing().sifs, Rank::kRadio, radio_.agent(),
                           [this] { open(); });
}

void FrameSequence::open() {
  if (exchange_.opening == Opening::kRts) {
    state_ = State::kWaitCts;
    return send(ppdu_of(make_rts()));
  }
  if (exchange_.opening == Opening::kCtsToSelf) {
    state_ = State::kReserving;
    return send(ppdu_of(make_cts_to_self()));
  }
  send(make_data());
}

/// Enters the state in which the data are sent.
PpduPtr FrameSequence::make_data() {
  state_ = exchange_.is_group() ? State::kGroup : State::kWaitAnswer;
  return originator_.make(exchange_, after_data(), events_.now());
}

void FrameSequence::send(const PpduPtr& ppdu) {
  radio_.transmit(ppdu);
  if (state_ == State::kIdle) return carrier_.update();
  carrier_.begin_exchange();
}

void FrameSequence::answer(FramePtr frame) { send_after_sifs(ppdu_of(std::move(frame))); }

void FrameSequence::send_after_sifs(PpduPtr ppdu) {
  next_ = std::move(ppdu);
  events_.cancel(sifs_);
  sifs_ = events_.schedule(events_.now() + timing().sifs, Rank::kRadio, radio_.agent(),
                           [this] { send(std::exchange(next_, nullptr)); });
}

void FrameSequence::on_transmit_end(const Ppdu& ppdu) {
  carrier_.on_right_frame();
  carrier_.update();
  if (state_ == State::kReserving) return send_after_sifs(make_data());
  if (state_ == State::kGroup) return end(ExchangeEnd::kDelivered, nullptr);
  const FrameType type = ppdu.first().type;
  const bool is_answer =
      type == FrameType::kCts || type == FrameType::kAck || type == FrameType::kBlockAck;
  if (is_answer) return;
  awaiting_ = true;
  const hal::Duration timeout = timing().response_timeout(modes_.response_to(*ppdu.mode));
  timeout_ = events_.schedule(events_.now() + timeout, Rank::kRadio, radio_.agent(),
                              [this] { on_timeout(); });
}

/// If there was a PHY-RXSTART, the frame may be the answer, and its end decides (10.3.2.11).
void FrameSequence::on_timeout() {
  const bool has_begun = radio_.is_receiving();
  if (awaiting_ && !has_begun) fail(false);
}

void FrameSequence::on_wrong_answer() {
  if (awaiting_) fail(true);
}

/// @param is_receiving  the radio is about to report whether the medium is idle.
void FrameSequence::fail(bool is_receiving) {
  events_.cancel(timeout_);
  awaiting_ = false;
  const bool was_data = state_ == State::kWaitAnswer;
  state_ = State::kIdle;
  carrier_.end_exchange(is_receiving);
  listener_.on_exchange_end(was_data ? ExchangeEnd::kNoAnswer : ExchangeEnd::kNoCts, nullptr);
}

void FrameSequence::end(ExchangeEnd how, const BlockAckFields* answer) {
  events_.cancel(timeout_);
  awaiting_ = false;
  const bool was_group = state_ == State::kGroup;
  state_ = State::kIdle;
  carrier_.end_exchange(!was_group);
  listener_.on_exchange_end(how, answer);
}

void FrameSequence::on_answer(const Frame& frame) {
  if (frame.type == FrameType::kBlockAck) {
    return end(ExchangeEnd::kBlockAck, frame.block_ack.get());
  }
  if (frame.type == FrameType::kAck) return end(ExchangeEnd::kDelivered, nullptr);
  events_.cancel(timeout_);
  awaiting_ = false;
  originator_.on_cts(exchange_);
  send_after_sifs(make_data());
}

void FrameSequence::reset() {
  events_.cancel(sifs_);
  events_.cancel(timeout_);
  state_ = State::kIdle;
  awaiting_ = false;
  next_.reset();
}

/// Duration of SIFS and the answer, if there is one.
hal::Duration FrameSequence::after_data() const {
  if (exchange_.is_group()) return {};
  if (!exchange_.has_block_ack()) {
    return timing().sifs + frames_.response_airtime(FrameType::kAck, *exchange_.mode);
  }
  const std::uint32_t bits = block_ack_bits(bitmap_length(exchange_.stream->window));
  return timing().sifs + modes_.response_to(*exchange_.mode).airtime(bits);
}

hal::Duration FrameSequence::data_and_after() const {
  return timing().sifs + exchange_.mode->airtime(exchange_.bits) + after_data();
}

FramePtr FrameSequence::make_rts() {
  const PhyMode& mode = originator_.protection().mode(exchange_.to, *exchange_.mode);
  const hal::Duration cts = frames_.response_airtime(FrameType::kCts, mode);
  return frames_.rts(exchange_.to, timing().sifs + cts + data_and_after(), mode);
}

FramePtr FrameSequence::make_cts_to_self() {
  return frames_.cts_to_self(data_and_after(),
                             originator_.protection().mode(radio_.agent(), *exchange_.mode));
}

}  // namespace sim::radio
