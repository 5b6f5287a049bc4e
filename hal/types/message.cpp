#include "hal/types/message.h"

namespace hal {

std::string_view to_string(Fate fate) {
  switch (fate) {
    case Fate::kHandedOver:
      return "handed over";
    case Fate::kNoRoute:
      return "no route";
    case Fate::kQueueFull:
      return "queue full";
    case Fate::kFailed:
      return "failed";
  }
  return {};
}

}  // namespace hal
