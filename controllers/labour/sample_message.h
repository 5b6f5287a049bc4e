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
  /// Number of the burst among the sender's, from 1; later bursts have greater numbers.
  std::uint32_t burst = 0;
  std::uint16_t index = 0;  ///< Number of the message in the burst, from 0.
  /// Number of different messages of the burst that the sink must receive.
  std::uint16_t needed = 1;
  bool operator==(const SampleMessage&) const = default;
};
inline constexpr std::size_t kSampleBytes = 8;   ///< Smallest size of a sample.
inline constexpr std::size_t kReceiptBytes = 4;  ///< Size of the sink's receipt.

/// @param size  bytes of the payload, padded with zeros; at least kSampleBytes.
inline hal::Bytes encode(const SampleMessage& sample, std::size_t size) {
  hal::PayloadWriter out;
  out.put(sample.burst).put(sample.index).put(sample.needed);
  hal::Bytes bytes = out.bytes();
  bytes.resize(std::max(size, kSampleBytes));
  return bytes;
}

/// nullopt if the bytes are not a sample.
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

/// The sink's receipt: it has received the required number of messages of that burst.
inline hal::Bytes receipt_for(std::uint32_t burst) {
  return hal::PayloadWriter().put(burst).bytes();
}

/// Number of the burst that is acknowledged; nullopt if the bytes are not a receipt.
inline std::optional<std::uint32_t> receipt_in(std::span<const std::uint8_t> payload) {
  if (payload.size() != kReceiptBytes) return std::nullopt;
  return hal::PayloadReader(payload).get<std::uint32_t>();
}

}  // namespace controllers
