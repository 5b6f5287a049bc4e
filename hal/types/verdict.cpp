#include "hal/types/verdict.h"

#include "hal/types/enum_names.h"

namespace hal {
namespace {

constexpr std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kDelivered:
      return "delivered";
    case Verdict::kBelowSensitivity:
      return "below sensitivity";
    case Verdict::kPreambleMissed:
      return "preamble missed";
    case Verdict::kCollision:
      return "collision";
    case Verdict::kInterference:
      return "interference";
    case Verdict::kNoise:
      return "noise";
    case Verdict::kObstacle:
      return "obstacle";
    case Verdict::kRetryLimit:
      return "retry limit";
    case Verdict::kQueueFull:
      return "queue full";
    case Verdict::kReceiverTransmitting:
      return "receiver transmitting";
    case Verdict::kRadioOff:
      return "radio off";
    case Verdict::kNoRoute:
      return "no route";
    case Verdict::kExpired:
      return "expired";
    case Verdict::kAgentDown:
      return "agent down";
    case Verdict::kRandomLoss:
      return "random loss";
    case Verdict::kQueueDelay:
      return "queue delay";
  }
  return {};
}
static_assert(names_exactly<Verdict, kVerdictCount>([](Verdict v) { return name_of(v); }));

}  // namespace

std::string_view name(Verdict verdict) { return name_of(verdict); }

}  // namespace hal
