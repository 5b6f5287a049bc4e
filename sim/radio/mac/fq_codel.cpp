#include "sim/radio/mac/fq_codel.h"

#include <algorithm>
#include <utility>

#include "sim/radio/mac/flow_hash.h"

namespace sim::radio {
namespace {

/// At most so many frames, and at most half of the flow, are dropped at once (RFC 8290, 4.1.3).
constexpr std::size_t kMostDropped = 64;

}  // namespace

std::uint32_t FqCodel::number_of(const WaitingMsdu& msdu) const {
  const std::uint64_t high = flow_hash(msdu, seed_) >> 32;
  return static_cast<std::uint32_t>(high * config_.flows >> 32);
}

void FqCodel::forget(const WaitingMsdu& msdu) {
  --frames_;
  bytes_ -= msdu.bytes();
}

void FqCodel::forget_from(std::size_t first, const DroppedMsdus& dropped) {
  for (std::size_t i = first; i < dropped.size(); ++i) forget(dropped[i].waiting);
}

void FqCodel::push(WaitingMsdu msdu, DroppedMsdus& dropped) {
  const std::uint32_t number = number_of(msdu);
  Flow& one = flow(number);
  ++frames_;
  bytes_ += msdu.bytes();
  one.queue.push(std::move(msdu));
  if (!one.is_listed) {
    one.is_listed = true;
    one.deficit = config_.quantum;
    new_.push_back(number);
  }
  while (is_over()) drop_of_fattest(dropped);
}

void FqCodel::drop_of_fattest(DroppedMsdus& dropped) {
  const auto fattest = std::ranges::max_element(flows_, {}, [](const auto& entry) {
    const FlowQueue& queue = entry.second.queue;
    return std::pair(queue.bytes(), queue.frames());
  });
  FlowQueue& queue = fattest->second.queue;
  const std::size_t most = std::clamp<std::size_t>(queue.frames() / 2, 1, kMostDropped);
  for (std::size_t i = 0; i < most; ++i) {
    std::optional<WaitingMsdu> oldest = queue.pop();
    forget(*oldest);
    dropped.push_back({std::move(*oldest), hal::Verdict::kQueueFull});
  }
}

std::optional<WaitingMsdu> FqCodel::pop_of(Flow& one, hal::Time now, DroppedMsdus& dropped) {
  const std::size_t before = dropped.size();
  std::optional<WaitingMsdu> next = one.codel.pop(one.queue, now, dropped);
  forget_from(before, dropped);
  if (!next) return std::nullopt;
  forget(*next);
  one.deficit -= static_cast<std::int64_t>(next->bytes());
  return next;
}

void FqCodel::expire(hal::Time before, DroppedMsdus& dropped) {
  const std::size_t first = dropped.size();
  for (auto& [number, one] : flows_) one.queue.expire(before, dropped);
  forget_from(first, dropped);
}

std::optional<WaitingMsdu> FqCodel::pop(hal::Time now, DroppedMsdus& dropped) {
  while (!new_.empty() || !old_.empty()) {
    const bool is_new = !new_.empty();
    std::deque<std::uint32_t>& list = is_new ? new_ : old_;
    const std::uint32_t number = list.front();
    Flow& one = flow(number);
    if (one.deficit <= 0) {
      one.deficit += config_.quantum;
      list.pop_front();
      old_.push_back(number);
      continue;
    }
    if (std::optional<WaitingMsdu> next = pop_of(one, now, dropped)) return next;
    list.pop_front();
    // An empty flow that was new takes a turn among the old ones before it may be new again.
    if (is_new && !old_.empty()) {
      old_.push_back(number);
    } else {
      one.is_listed = false;
    }
  }
  return std::nullopt;
}

}  // namespace sim::radio
