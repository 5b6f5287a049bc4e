#pragma once

#include <cstdint>
#include <string_view>

namespace hal {

/// How a frame at a receiver, or a message, ended. Every one ends in exactly one verdict.
enum class Verdict : std::uint8_t {
  kDelivered,
  kBelowSensitivity,
  kPreambleMissed,
  kCollision,     ///< Another frame was there: SINR too low.
  kInterference,  ///< Lost to the sum of frames too weak to be received.
  kNoise,         ///< Lost to thermal noise alone.
  kObstacle,      ///< Would have been received but for a wall.
  kRetryLimit,
  kQueueFull,
  kReceiverTransmitting,
  kRadioOff,
  kNoRoute,
  kExpired,
  kAgentDown,
  kRandomLoss,  ///< The physics would have let it in; the scenario's `loss` did not.
};
inline constexpr int kVerdictCount = 15;

/// "delivered", "below sensitivity", …
std::string_view name(Verdict verdict);

}  // namespace hal
