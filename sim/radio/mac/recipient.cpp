#include "sim/radio/mac/recipient.h"

#include <algorithm>

namespace sim::radio {

Recipient::Recipient(EventQueue& events, hal::AgentId agent, const DcfConfig& config,
                     FrameFactory& frames, RecipientListener& listener)
    : events_(events), agent_(agent), config_(config), frames_(frames), listener_(listener) {}

Recipient::~Recipient() { reset(); }

void Recipient::reset() {
  for (auto& [key, agreement] : agreements_) events_.cancel(agreement.gap);
  agreements_.clear();
}

Recipient::Agreement* Recipient::agreement_for(const Frame& frame) {
  if (!frame.qos) return nullptr;
  const auto found = agreements_.find({frame.transmitter, frame.priority});
  return found == agreements_.end() ? nullptr : &found->second;
}

FramePtr Recipient::answer_to(const ReceivedPpdu& received) {
  const Frame& first = received.ppdu.first();
  Agreement* const agreement = agreement_for(first);
  if (agreement != nullptr) {
    for (std::size_t i = 0; i < received.verdicts.size(); ++i) {
      if (received.verdicts[i] != hal::Verdict::kDelivered) continue;
      agreement->state.score(received.ppdu.parts[i].frame->sequence);
    }
  }
  if (!received.ppdu.is_aggregate()) return frames_.ack(first, received.snr);
  if (agreement != nullptr) {
    return frames_.block_ack(first, agreement->state.block_ack(first.priority), received.snr);
  }
  // The originator believes in an agreement that this station has forgotten.
  listener_.send_action(first, DeleteBlockAck{false, first.priority, kReasonUnknownBlockAck});
  return nullptr;
}

void Recipient::accept(const ReceivedPpdu& received) {
  for (std::size_t i = 0; i < received.verdicts.size(); ++i) {
    if (received.verdicts[i] != hal::Verdict::kDelivered) continue;
    accept({received.ppdu.parts[i].frame, received.rssi, received.snr, events_.now()});
  }
}

void Recipient::accept(const ReceivedMpdu& mpdu) {
  Agreement* const agreement = agreement_for(*mpdu.frame);
  if (agreement == nullptr) {
    if (duplicates_.is_duplicate(*mpdu.frame)) return;
    return listener_.on_mpdu(*mpdu.frame, mpdu.rssi, mpdu.snr);
  }
  const std::vector<ReceivedMpdu> released = agreement->state.accept(mpdu);
  watch_gap(*agreement);
  pass_on(released);
}

void Recipient::pass_on(const std::vector<ReceivedMpdu>& released) {
  for (const ReceivedMpdu& one : released) listener_.on_mpdu(*one.frame, one.rssi, one.snr);
}

void Recipient::watch_gap(Agreement& agreement) {
  events_.cancel(agreement.gap);
  const std::optional<hal::Time> since = agreement.state.waiting_since();
  if (!since) return;
  const hal::Time until = std::max(events_.now(), *since + config_.aggregation.reorder_timeout);
  agreement.gap = events_.schedule(until, Rank::kRadio, agent_, [this, &agreement] {
    const std::vector<ReceivedMpdu> released = agreement.state.skip_gap();
    watch_gap(agreement);
    pass_on(released);
  });
}

FramePtr Recipient::answer_to_request(const Frame& request) {
  const BlockAckFields& asked = *request.block_ack;
  const auto found = agreements_.find({request.transmitter, asked.tid});
  if (found == agreements_.end()) {
    listener_.send_action(request, DeleteBlockAck{false, asked.tid, kReasonUnknownBlockAck});
    return nullptr;
  }
  Agreement& agreement = found->second;
  const std::vector<ReceivedMpdu> released = agreement.state.move_to(asked.start);
  FramePtr answer = frames_.block_ack(request, agreement.state.block_ack(asked.tid));
  watch_gap(agreement);
  pass_on(released);
  return answer;
}

void Recipient::on_request(const Frame& frame, const AddBlockAckRequest& request) {
  const hal::AgentId from = frame.transmitter;
  const std::uint32_t window = std::min(request.window, config_.aggregation.block_ack_window);
  const bool is_possible = config_.qos && window > 0;
  if (is_possible) {
    const auto known = agreements_.find({from, request.tid});
    if (known != agreements_.end()) {
      events_.cancel(known->second.gap);
      agreements_.erase(known);
    }
    agreements_.emplace(Key{from, request.tid},
                        Agreement{RecipientAgreement(request.start, window)});
  }
  constexpr std::uint16_t kRefused = 37;  // 9.4.1.9: the request has been declined
  listener_.send_action(frame,
                        AddBlockAckResponse{.dialog_token = request.dialog_token,
                                            .status = is_possible ? std::uint16_t{0} : kRefused,
                                            .tid = request.tid,
                                            .window = window});
}

void Recipient::on_delete(hal::AgentId from, const DeleteBlockAck& del) {
  const auto found = agreements_.find({from, del.tid});
  if (found == agreements_.end()) return;
  events_.cancel(found->second.gap);
  const std::vector<ReceivedMpdu> released = found->second.state.skip_gap();
  agreements_.erase(found);
  pass_on(released);
}

}  // namespace sim::radio
