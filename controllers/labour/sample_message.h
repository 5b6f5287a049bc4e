#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/types/message.h"
#include "hal/types/payload.h"

namespace controllers {

/// One of the messages of a burst of samples, from an agent to the sink.
struct SampleMessage {
  /// Number of the burst among the sender's, from 1; later ones have greater ones.
  std::uint32_t burst = 0;
  std::uint16_t index = 0;   ///< Of the message in the burst, from 0.
  std::uint16_t needed = 1;  ///< So many different ones of the burst make it good.
  bool operator==(const SampleMessage&) const = default;
};
inline constexpr std::size_t kSampleBytes = 8;   ///< The least size of a sample.
inline constexpr std::size_t kReceiptBytes = 4;  ///< The size of the sink's answer.

/// @param size  bytes of the payload: zeros follow what it says; at least kSampleBytes.
inline hal::Bytes encode(const SampleMessage& sample, std::size_t size) {
  hal::PayloadWriter out;
  out.put(sample.burst).put(sample.index).put(sample.needed);
  hal::Bytes bytes = out.bytes();
  bytes.resize(std::max(size, kSampleBytes));
  return bytes;
}

/// None: the bytes are no sample.
inline std::optional<SampleMessage> sample_in(std::span<const std::uint8_t> payload) {
  if (payload.size() < kSampleBytes) return std::nullopt;
  hal::PayloadReader in(payload.first(kSampleBytes));
  SampleMessage sample;
  sample.burst = in.get<std::uint32_t>();
  sample.index = in.get<std::uint16_t>();
  sample.needed = in.get<std::uint16_t>();
  if (sample.burst == 0 || sample.needed == 0) return std::nullopt;
  return sample;
}

/// The sink's answer: it has what it needs of that burst.
inline hal::Bytes receipt_for(std::uint32_t burst) {
  return hal::PayloadWriter().put(burst).bytes();
}

/// Number of the burst that the sink has got; none: the bytes are no receipt.
inline std::optional<std::uint32_t> receipt_in(std::span<const std::uint8_t> payload) {
  if (payload.size() != kReceiptBytes) return std::nullopt;
  return hal::PayloadReader(payload).get<std::uint32_t>();
}

}  // namespace controllers
