#include <algorithm>

#include "sim/air/ledger.h"

namespace sim::air {

/// The place of a new frame. It is not that of a frame of the same A-MPDU or of the one before,
/// which may still be propagating.
Ledger::Sent& Ledger::Station::place_for(const radio::Frame& frame) {
  last = (last + 1) & (sent.size() - 1);
  const std::uint32_t oldest = sent[last].ampdu;
  if (frame.ampdu != 0 && oldest != 0 && oldest + 1 >= frame.ampdu) {
    std::rotate(sent.begin(), sent.begin() + static_cast<std::ptrdiff_t>(last), sent.end());
    last = sent.size();
    sent.resize(2 * sent.size());
  }
  return sent[last];
}

Ledger::Sent* Ledger::Station::find(std::uint64_t frame) {
  // The frames of an A-MPDU have successive numbers.
  const std::uint64_t back = sent[last].frame - frame;
  if (back < sent.size()) {
    Sent& one = sent[(last - back) & (sent.size() - 1)];
    if (one.frame == frame) return &one;
  }
  const auto found = std::ranges::find(sent, frame, &Sent::frame);
  return found == sent.end() ? nullptr : &*found;
}

void Ledger::Station::on_attempt(const radio::Frame& frame, const hal::Bytes* payload) {
  auto known = unfinished.end();
  if (frame.retry && !unfinished.empty()) {
    // Without A-MPDUs it is the last one.
    const bool is_last = unfinished.back().payload == payload;
    known = is_last ? std::prev(unfinished.end())
                    : std::ranges::find(unfinished, payload, &Attempts::payload);
  }
  if (known == unfinished.end()) {
    if (unfinished.size() >= kMostUnfinished) unfinished.erase(unfinished.begin());
    known = unfinished.insert(unfinished.end(), {.payload = payload});
  }
  known->last = {frame.id, frame.receiver};
}

void Ledger::Station::on_attempt_end(const radio::Frame& frame, hal::Verdict verdict) {
  if (rts.frame == frame.id) rts.verdict = verdict;
  if (frame.type != radio::FrameType::kData) return;
  const auto is_of_frame = [&frame](const Attempts& one) { return one.last.frame == frame.id; };
  const auto from =
      unfinished.begin() + static_cast<std::ptrdiff_t>(std::min(last_end, unfinished.size()));
  auto one = std::find_if(from, unfinished.end(), is_of_frame);
  if (one == unfinished.end()) one = std::find_if(unfinished.begin(), from, is_of_frame);
  for (; one != unfinished.end() && is_of_frame(*one); ++one) {
    one->last.verdict = verdict;
    one->has_arrived |= verdict == hal::Verdict::kDelivered;
    last_end = static_cast<std::size_t>(one - unfinished.begin());
  }
}

Ledger::Attempts Ledger::Station::take(const hal::Bytes* payload, bool was_served) {
  const auto found = std::ranges::find(unfinished, payload, &Attempts::payload);
  if (found == unfinished.end()) {
    // It was given up after RTS only.
    if (!was_served) return {};
    return {.payload = payload, .last = rts};
  }
  Attempts attempts = *found;
  unfinished.erase(found);
  const bool is_rts_later = rts.frame > attempts.last.frame;
  if (is_rts_later && rts.receiver == attempts.last.receiver) attempts.last = rts;
  return attempts;
}

}  // namespace sim::air
