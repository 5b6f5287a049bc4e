#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/types/message.h"
#include "hal/types/payload.h"
#include "hal/types/time.h"

namespace controllers {

/// Start of a traffic source's message, if the message is long enough.
struct TrafficStamp {
  hal::Time sent{};          ///< By the clock of the source.
  std::uint32_t number = 0;  ///< Number of the message among the source's, from 1.
};
inline constexpr std::size_t kStampBytes = 12;

/// A payload of `size` bytes: the stamp, then zeros; zeros alone if the stamp does not fit.
inline hal::Bytes stamped(const TrafficStamp& stamp, std::size_t size) {
  if (size < kStampBytes) return hal::Bytes(size);
  hal::PayloadWriter out;
  out.put(stamp.sent).put(stamp.number);
  hal::Bytes bytes = out.bytes();
  bytes.resize(size);
  return bytes;
}

/// nullopt: the payload is too short for a stamp, or has none.
inline std::optional<TrafficStamp> stamp_in(std::span<const std::uint8_t> payload) {
  if (payload.size() < kStampBytes) return std::nullopt;
  hal::PayloadReader in(payload.first(kStampBytes));
  TrafficStamp stamp;
  stamp.sent = in.get<hal::Time>();
  stamp.number = in.get<std::uint32_t>();
  if (!in.ended_well() || stamp.number == 0) return std::nullopt;
  return stamp;
}

}  // namespace controllers
