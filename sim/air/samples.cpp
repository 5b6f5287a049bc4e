#include "sim/air/samples.h"

#include <algorithm>

namespace sim::air {
namespace {

/// Fragments [first, end) of a part, numbered from 0, limited to the number that the sample has.
std::pair<std::uint32_t, std::uint32_t> range_of(const DatagramPart& part, std::size_t all) {
  const auto end =
      std::min<std::size_t>(std::size_t{part.first_fragment} - 1 + part.fragments, all);
  return {std::min(part.first_fragment - 1, static_cast<std::uint32_t>(all)),
          static_cast<std::uint32_t>(end)};
}

}  // namespace

Samples::Sample* Samples::find(const DatagramPart& part) {
  const auto found = open_.find({part.writer, part.sequence_number});
  return found == open_.end() ? nullptr : &found->second;
}

bool Samples::is_old(const DatagramPart& part) const {
  const auto settled = settled_.find(part.writer);
  return settled != settled_.end() && part.sequence_number <= settled->second;
}

/// @return null if the sample is too old, has no matched readers, or exceeds the limits.
Samples::Sample* Samples::begin(hal::Time at, const DatagramPart& part) {
  if (is_old(part) || part.writer == 0 || part.all_fragments > kMostFragments) return nullptr;
  const std::vector<hal::AgentId> readers = endpoints_.readers_of(part.writer);
  const std::size_t fragments = readers.size() * part.all_fragments;
  if (readers.empty() || fragments > kMostOpenFragments) return nullptr;
  while (open_fragments_ + fragments > kMostOpenFragments) settle_front(false);
  if (is_old(part)) return nullptr;  // settled by the line above
  open_fragments_ += fragments;
  const SampleKey key{part.writer, part.sequence_number};
  Sample& sample = open_[key];
  order_.push_back(key);
  for (const hal::AgentId reader : readers) {
    Progress& progress = sample.to.emplace_back();
    progress.delivery = {.writer = part.writer,
                         .sequence_number = part.sequence_number,
                         .receiver = reader,
                         .entered = at,
                         .bytes = part.sample_size,
                         .fragments = part.all_fragments};
    progress.first.assign(part.all_fragments, 0);
    progress.got.assign(part.all_fragments, false);
    progress.missing = part.all_fragments;
  }
  return &sample;
}

bool Samples::is_for(const DatagramPart& part, hal::AgentId destination,
                     hal::AgentId receiver) const {
  if (destination != hal::kEveryone && destination != receiver) return false;
  if (part.to == hal::rtps::GuidPrefix{}) return true;
  const auto agent = endpoints_.agent_of(part.to);
  return !agent || *agent == receiver;
}

std::uint32_t Samples::Progress::send(const DatagramPart& part, std::uint64_t serial) {
  if (first.empty()) return part.fragments;
  std::uint32_t repeated = 0;
  const auto [begin, end] = range_of(part, first.size());
  for (std::uint32_t i = begin; i < end; ++i) {
    if (first[i] == 0) {
      first[i] = serial;
    } else {
      ++repeated;
    }
  }
  return repeated;
}

void Samples::on_sent(hal::Time at, const Datagram& datagram, const DatagramPart& part,
                      hal::AgentId destination) {
  now_ = at;
  Sample* sample = find(part);
  if (sample == nullptr) sample = begin(at, part);
  if (sample == nullptr) return;
  sample->last_sent = at;
  for (Progress& progress : sample->to) {
    if (!is_for(part, destination, progress.delivery.receiver)) continue;
    const std::uint32_t repairs = progress.send(part, datagram.serial);
    progress.delivery.repairs += repairs;
    const bool is_new = !std::exchange(progress.was_sent, true);
    if (watcher_ != nullptr) tell_sent(at, *sample, progress, is_new, repairs);
  }
}

void Samples::tell_sent(hal::Time at, const Sample& sample, const Progress& progress, bool is_new,
                        std::uint32_t repairs) {
  if (is_new) {
    const auto sent_to = std::ranges::count_if(sample.to, &Progress::was_sent);
    watcher_->on_sample_sent(at, progress.delivery, sent_to == 1);
  }
  if (repairs > 0) watcher_->on_sample_repair(at, progress.delivery, repairs);
}

bool Samples::is_for(const Whom& whom, hal::AgentId receiver) const {
  if (whom.destination != hal::kEveryone) return whom.destination == receiver;
  if (!whom.access_point) return true;
  const auto with = with_.find(receiver);
  return with != with_.end() && with->second == *whom.access_point;
}

/// Calls act(losses, range of fragments) for each delivery in progress to agents that a carrier is
/// for.
template <class Act>
void Samples::for_lost(const DatagramPart& part, const Whom& whom, const Act& act) {
  Sample* const sample = find(part);
  if (sample == nullptr) return;
  for (Progress& progress : sample->to) {
    const hal::AgentId receiver = progress.delivery.receiver;
    if (progress.delivery.left || !is_for(part, whom.destination, receiver)) continue;
    if (is_for(whom, receiver)) act(progress.losses, range_of(part, progress.got.size()));
  }
}

void Samples::on_lost(const DatagramPart& part, const Whom& whom, const SampleLoss& loss) {
  for_lost(part, whom,
           [&loss](SampleLosses& losses, const auto& range) { losses.add(loss, range); });
}

void Samples::on_group_frame(const DatagramPart& part, const Whom& whom,
                             const SampleLoss& unnoticed, hal::Time over) {
  for_lost(part, whom,
           [&](SampleLosses& losses, const auto& range) { losses.expect(unnoticed, range, over); });
}

void Samples::on_group_frame_end(const DatagramPart& part, const Whom& whom, std::uint64_t frame,
                                 const std::optional<SampleLoss>& loss) {
  for_lost(part, whom, [&](SampleLosses& losses, const auto& range) {
    losses.on_heard(frame);
    if (loss) losses.add(*loss, range);
  });
}

void Samples::Progress::take(const DatagramPart& part, std::uint64_t serial) {
  const auto [begin, end] = range_of(part, got.size());
  for (std::uint32_t i = begin; i < end; ++i) {
    if (got[i]) continue;
    got[i] = true;
    --missing;
    if (first[i] != serial) delivery.is_repaired = true;
  }
}

void Samples::on_received(hal::Time at, const Datagram& datagram, const DatagramPart& part,
                          hal::AgentId receiver) {
  Sample* const sample = find(part);
  if (sample == nullptr) return;
  // A reader drops samples of a writer that it does not know yet.
  if (!endpoints_.all()[part.writer].known_at.contains(receiver)) {
    const LossCause cause{.kind = LossCause::Kind::kNotMatched, .at = receiver};
    return on_lost(part, {.destination = receiver}, {.cause = cause});
  }
  for (Progress& progress : sample->to) {
    if (!is_for(part, receiver, progress.delivery.receiver) || progress.delivery.left) continue;
    progress.take(part, datagram.serial);
    if (progress.missing > 0) continue;
    progress.delivery.left = at;
    release(progress);
    if (watcher_ != nullptr && progress.was_sent) watcher_->on_sample_delivered(progress.delivery);
  }
}

void Samples::release(Progress& progress) {
  open_fragments_ -= progress.first.size();
  std::vector<std::uint64_t>().swap(progress.first);
  std::vector<bool>().swap(progress.got);
  progress.losses.clear();
}

void Samples::settle(hal::Time now) {
  now_ = now;
  while (!order_.empty()) {
    const auto oldest = open_.find(order_.front());
    const bool is_due = oldest->second.last_sent + kSettled < now;
    if (!is_due && open_.size() <= kMostOpen) return;
    settle_front(false);
  }
}

void Samples::finish(hal::Time now) {
  settle(now);
  while (!order_.empty()) settle_front(true);
}

void Samples::settle_front(bool is_end) {
  const SampleKey key = order_.front();
  order_.pop_front();
  const auto oldest = open_.find(key);
  std::int64_t& highest = settled_[key.first];
  highest = std::max(highest, key.second);
  settle(oldest->second, is_end);
  open_.erase(oldest);
}

void Samples::settle(Sample& sample, bool is_end) {
  for (Progress& progress : sample.to) {
    SampleDelivery& delivery = progress.delivery;
    if (!delivery.left) {
      progress.losses.settle(now_);
      delivery.loss = progress.losses.last(progress.got).value_or(SampleLoss{});
      // A sample that came too early will be retransmitted on request.
      delivery.is_under_way = is_end && delivery.loss->cause.kind != LossCause::Kind::kVerdict;
      if (delivery.is_under_way) delivery.loss.reset();
    }
    release(progress);
    if (!progress.was_sent) continue;
    count(delivery);
    if (sink_) sink_(delivery);
  }
}

void Samples::count(const SampleDelivery& delivery) {
  SampleSums& sums = sums_[{delivery.writer, delivery.receiver}];
  sums.changed = true;
  ++sums.samples;
  sums.repairs += delivery.repairs;
  sums.fragments += delivery.fragments;
  sums.bytes += delivery.bytes;
  if (delivery.is_under_way) {
    ++sums.under_way;
  } else if (!delivery.left) {
    ++sums.lost[delivery.loss->cause];
  } else {
    ++sums.delivered;
    sums.first_try += delivery.is_repaired ? 0 : 1;
    sums.latency_sum += *delivery.left - delivery.entered;
    sums.latencies.add(*delivery.left - delivery.entered);
  }
}

}  // namespace sim::air
