#include "hal/types/verdict.h"

namespace hal {

std::string_view name(Verdict verdict) {
  constexpr std::string_view kNames[kVerdictCount] = {
      "delivered", "below sensitivity", "preamble missed", "collision",  "interference",
      "noise",     "obstacle",          "retry limit",     "queue full", "receiver transmitting",
      "radio off", "no route",          "expired",         "agent down", "random loss"};
  return kNames[static_cast<int>(verdict)];
}

}  // namespace hal
