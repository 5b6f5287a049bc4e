#include "sim/radio/mac/aggregation.h"

#include <algorithm>
#include <utility>

#include "sim/radio/mac/frame_lengths.h"

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

bool belongs(const MpduStream& stream, const Outgoing& outgoing) {
  return outgoing.request.destination == stream.to && outgoing.request.priority == stream.tid &&
         !outgoing.is_management();
}

}  // namespace

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
  return config_.msdu_lifetime && now - outgoing.queued > *config_.msdu_lifetime;
}

/// Takes the next MSDU of the stream out of the queue, with those that follow it into one A-MSDU.
/// @param place  where to look from; left at the place after it.
std::optional<Mpdu> Aggregation::next_mpdu(const MpduStream& stream, TxQueue& queue,
                                           std::size_t& place, hal::Time now) const {
  const auto find = [&] {
    while (place < queue.size() &&
           (!belongs(stream, queue.at(place)) || is_expired(queue.at(place), now))) {
      ++place;
    }
    return place < queue.size();
  };
  if (!find()) return std::nullopt;
  Mpdu mpdu;
  mpdu.bits = bits_of(config_.lengths, queue.at(place));
  std::uint32_t amsdu = amsdu_subframe_bytes(queue.at(place));
  mpdu.msdus.push_back(queue.take(place, now));
  while (find() && amsdu_bytes(amsdu, queue.at(place)) <= config_.aggregation.max_amsdu) {
    amsdu = amsdu_bytes(amsdu, queue.at(place));
    mpdu.msdus.push_back(queue.take(place, now));
  }
  if (mpdu.msdus.size() > 1) {
    constexpr std::uint32_t kQosHeaderAndFcs = 26 + 4;
    mpdu.bits = 8 * (kQosHeaderAndFcs + amsdu);
  }
  return mpdu;
}

PsduSize Aggregation::fill(MpduStream& stream, TxQueue& queue, const PpduLimits& limits,
                           hal::Time now) const {
  PsduSize size;
  for (const Mpdu& mpdu : stream.in_flight) {
    const std::optional<PsduSize> next = with(size, mpdu.bits, limits);
    // Without an agreement, MPDUs of an earlier one are sent one by one.
    if (!next || size.mpdus == stream.window) return finished(size, stream, limits.mode);
    size = *next;
  }
  std::size_t place = 0;
  while (stream.has_room()) {
    std::optional<Mpdu> mpdu = next_mpdu(stream, queue, place, now);
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
