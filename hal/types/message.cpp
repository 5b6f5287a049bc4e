#include "hal/types/message.h"

namespace hal {

std::string_view to_string(Fate fate) {
  constexpr std::string_view kNames[] = {"handed over", "no route", "queue full", "failed"};
  return kNames[static_cast<int>(fate)];
}

}  // namespace hal
