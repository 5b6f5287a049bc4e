#include "sim/radio/mac/recipient_agreement.h"

#include <algorithm>
#include <utility>

namespace sim::radio {

void RecipientAgreement::score(std::uint16_t sequence) {
  std::uint32_t place = steps(scored_from_, sequence);
  if (is_old(static_cast<std::uint16_t>(place))) return;
  if (place >= window_) {
    const std::uint32_t shift = place - window_ + 1;
    scored_ >>= shift;
    scored_from_ = later(scored_from_, shift);
    place = window_ - 1;
  }
  scored_.set(place);
}

BlockAckFields RecipientAgreement::block_ack(std::uint8_t tid) const {
  return {.tid = tid, .start = scored_from_, .length = bitmap_length(window_), .received = scored_};
}

std::vector<ReceivedMpdu> RecipientAgreement::accept(const ReceivedMpdu& mpdu) {
  std::vector<ReceivedMpdu> released;
  std::uint32_t place = steps(next_, mpdu.frame->sequence);
  if (is_old(static_cast<std::uint16_t>(place))) return released;
  if (place >= window_) {
    advance(place - window_ + 1, released);
    place = window_ - 1;
  }
  if (place >= buffer_.size()) buffer_.resize(place + 1);
  if (!buffer_[place]) buffer_[place] = mpdu;
  release(released);
  return released;
}

std::vector<ReceivedMpdu> RecipientAgreement::move_to(std::uint16_t start) {
  std::vector<ReceivedMpdu> released;
  const std::uint16_t scored = steps(scored_from_, start);
  if (!is_old(scored)) {
    scored_ >>= scored;
    scored_from_ = start;
  }
  const std::uint16_t place = steps(next_, start);
  if (!is_old(place)) advance(place, released);
  release(released);
  return released;
}

std::vector<ReceivedMpdu> RecipientAgreement::skip_gap() {
  std::vector<ReceivedMpdu> released;
  const auto first =
      std::ranges::find_if(buffer_, [](const auto& slot) { return slot.has_value(); });
  advance(static_cast<std::uint32_t>(first - buffer_.begin()), released);
  release(released);
  return released;
}

std::optional<hal::Time> RecipientAgreement::waiting_since() const {
  const auto first =
      std::ranges::find_if(buffer_, [](const auto& slot) { return slot.has_value(); });
  if (first == buffer_.end()) return std::nullopt;
  return (*first)->at;
}

/// Moves the window by so many MPDUs; those that are there are released.
void RecipientAgreement::advance(std::uint32_t count, std::vector<ReceivedMpdu>& released) {
  next_ = later(next_, count);
  for (; count > 0 && !buffer_.empty(); --count) {
    if (buffer_.front()) released.push_back(std::move(*buffer_.front()));
    buffer_.pop_front();
  }
}

void RecipientAgreement::release(std::vector<ReceivedMpdu>& released) {
  while (!buffer_.empty() && buffer_.front()) advance(1, released);
}

}  // namespace sim::radio
