#include "sim/radio/mac/aggregation.h"

#include <algorithm>
#include <utility>

#include "sim/radio/mac/frame_lengths.h"
#include "sim/radio/mac/lifetime.h"

namespace sim::radio {
namespace {

constexpr std::uint32_t kDelimiterBits = 32;
constexpr std::uint32_t kAlignmentBits = 32;
constexpr std::uint32_t kAmsduHeaderBytes = 14;  // destination, source, length
constexpr std::uint32_t kSnapBytes = 8;

constexpr std::uint32_t padded(std::uint32_t size, std::uint32_t to) {
  return (size + to - 1) / to * to;
}

std::uint32_t amsdu_subframe_bytes(const Outgoing& msdu) {
  return kAmsduHeaderBytes + kSnapBytes + static_cast<std::uint32_t>(msdu.request.payload->size());
}

/// Length of an A-MSDU: subframes, each but the last padded to four bytes (9.3.2.2.2).
std::uint32_t amsdu_bytes(std::uint32_t before, const Outgoing& next) {
  return padded(before, 4) + amsdu_subframe_bytes(next);
}

std::uint32_t bits_of(const LengthsConfig& lengths, const Outgoing& msdu) {
  return mpdu_bits(lengths, FrameType::kData, msdu.request.payload->size()) + kQosControlBits;
}

/// Length of the PSDU of a single MPDU: in VHT and HE it has a delimiter, too (an S-MPDU).
std::uint32_t single_bits(const PhyMode& mode, std::uint32_t mpdu_bits) {
  return mpdu_bits + (mode.modulation_class() > ModulationClass::kHt ? kDelimiterBits : 0);
}

PsduSize finished(const PsduSize& size, const MpduStream& stream, const PhyMode& mode) {
  if (size.mpdus != 1) return size;
  return {1, single_bits(mode, stream.in_flight.front().bits)};
}

}  // namespace

bool Aggregation::belongs(const MpduStream& stream, const Outgoing& outgoing) {
  return outgoing.request.destination == stream.to && outgoing.request.priority == stream.tid &&
         !outgoing.is_management();
}

std::uint32_t Aggregation::subframe_begin(std::uint32_t bits) {
  return padded(bits, kAlignmentBits);
}

std::uint32_t Aggregation::with_subframe(std::uint32_t bits, std::uint32_t mpdu_bits) {
  return subframe_begin(bits) + kDelimiterBits + mpdu_bits;
}

/// The size with one more MPDU; nullopt: it does not fit.
std::optional<PsduSize> Aggregation::with(const PsduSize& size, std::uint32_t mpdu_bits,
                                          const PpduLimits& limits) const {
  const PsduSize next{size.mpdus + 1, with_subframe(size.bits, mpdu_bits)};
  const bool is_single = size.mpdus == 0;
  const std::uint32_t most = std::min(config_.aggregation.max_ampdu, limits.mode.longest_psdu());
  if (!is_single && next.bits > 8 * most) return std::nullopt;
  if (is_single && limits.single_may_exceed) return next;
  const std::uint32_t bits = is_single ? single_bits(limits.mode, mpdu_bits) : next.bits;
  if (limits.mode.airtime(bits) > limits.airtime) return std::nullopt;
  return next;
}

bool Aggregation::is_expired(const Outgoing& outgoing, hal::Time now) const {
  const std::optional<hal::Duration> lifetime = lifetime_of(config_, outgoing.request.priority);
  return lifetime && now - outgoing.queued > *lifetime;
}

/// Goes to the next MSDU of the stream in the queue. @return whether there is one.
bool Aggregation::find(const MpduStream& stream, Supply& supply) const {
  TxQueue& queue = supply.queue;
  for (;; ++supply.place) {
    const bool is_there = supply.place < queue.size() || (supply.more && supply.more());
    if (!is_there) return false;
    const Outgoing& next = queue.at(supply.place);
    if (belongs(stream, next) && !is_expired(next, supply.now)) return true;
  }
}

/// Takes the next MSDU of the stream out of the queue, with those that follow it into one A-MSDU.
std::optional<Mpdu> Aggregation::next_mpdu(const MpduStream& stream, Supply& supply) const {
  if (!find(stream, supply)) return std::nullopt;
  TxQueue& queue = supply.queue;
  const std::size_t& place = supply.place;
  Mpdu mpdu;
  mpdu.bits = bits_of(config_.lengths, queue.at(place));
  std::uint32_t amsdu = amsdu_subframe_bytes(queue.at(place));
  mpdu.msdus.push_back(queue.take(place, supply.now));
  while (config_.aggregation.max_amsdu > 0 && find(stream, supply) &&
         amsdu_bytes(amsdu, queue.at(place)) <= config_.aggregation.max_amsdu) {
    amsdu = amsdu_bytes(amsdu, queue.at(place));
    mpdu.msdus.push_back(queue.take(place, supply.now));
  }
  if (mpdu.msdus.size() > 1) {
    constexpr std::uint32_t kQosHeaderAndFcs = 26 + 4;
    mpdu.bits = 8 * (kQosHeaderAndFcs + amsdu);
  }
  return mpdu;
}

PsduSize Aggregation::fill(MpduStream& stream, TxQueue& queue, const PpduLimits& limits,
                           hal::Time now, const std::function<bool()>& more) const {
  PsduSize size;
  for (const Mpdu& mpdu : stream.in_flight) {
    const std::optional<PsduSize> next = with(size, mpdu.bits, limits);
    // Without an agreement, MPDUs of an earlier one are sent one by one.
    if (!next || size.mpdus == stream.window) return finished(size, stream, limits.mode);
    size = *next;
  }
  Supply supply{queue, more, now};
  while (stream.has_room()) {
    std::optional<Mpdu> mpdu = next_mpdu(stream, supply);
    if (!mpdu) break;
    const std::optional<PsduSize> next = with(size, mpdu->bits, limits);
    mpdu->sequence = stream.take_number();
    stream.in_flight.push_back(std::move(*mpdu));
    if (!next) break;  // it is the first of the next A-MPDU
    size = *next;
  }
  return finished(size, stream, limits.mode);
}

}  // namespace sim::radio
