#pragma once

#include <cstdint>
#include <string_view>

namespace hal {

/// How a frame ended at a receiver, or a message in the network. Each ends in exactly one verdict.
enum class Verdict : std::uint8_t {
  kDelivered,             ///< Received; by a sender's link: acknowledged, or broadcast sent.
  kBelowSensitivity,      ///< Received power below the sensitivity.
  kPreambleMissed,        ///< The receiver did not synchronise with the frame.
  kCollision,             ///< SINR too low because of another frame.
  kInterference,          ///< Lost to the sum of frames too weak to be received.
  kNoise,                 ///< Lost to thermal noise alone.
  kObstacle,              ///< Would have been received without a wall in between.
  kRetryLimit,            ///< Not acknowledged after the last retry.
  kQueueFull,             ///< A queue of the sender had no room.
  kReceiverTransmitting,  ///< The receiver's own radio was transmitting.
  kRadioOff,              ///< A radio, the sender's or the receiver's, was off or went off.
  kNoRoute,               ///< No route to the destination was found.
  kExpired,               ///< Exceeded its lifetime, its waiting time or its hop limit.
  kAgentDown,             ///< Reserved; no component reports it at present.
  kRandomLoss,            ///< Would have been received without the scenario's `loss`.
  kQueueDelay,            ///< Dropped by CoDel, because frames waited too long in their queue.
};
/// Number of verdicts.
inline constexpr int kVerdictCount = 16;

/// "delivered", "below sensitivity", …
std::string_view name(Verdict verdict);

}  // namespace hal
