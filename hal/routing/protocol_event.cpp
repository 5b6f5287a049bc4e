#include "hal/routing/protocol_event.h"

#include <array>

namespace hal::routing {
namespace {

/// In the order of the enumeration.
constexpr std::array<std::string_view, kProtocolEvents> kEventNames{
    "neighbour lost",
    "hello sent",
    "forward ant sent",
    "forward ant relayed",
    "forward ant answered",
    "backward ant relayed",
    "backward ant home",
    "flood relayed",
    "flood copy dropped",
    "rreq sent",
    "rreq forwarded",
    "rreq delayed",
    "rrep sent",
    "rrep sent for another",
    "gratuitous rrep sent",
    "rrep forwarded",
    "rrep received",
    "rrep lost",
    "rreq from blacklisted",
    "rerr sent",
    "rerr received",
    "rerr suppressed",
    "local repair started",
    "local repair done",
    "local repair failed",
    "proactive ant sent",
    "repair ant sent",
    "forward ant passed on",
    "forward ant dropped",
    "pheromone bootstrapped",
    "loss notice sent",
    "loss notice received",
    "warning sent",
    "warning received",
    "repair succeeded",
    "repair failed",
    "message salvaged",
};
static_assert(!kEventNames.back().empty());

}  // namespace

std::string_view name(ProtocolEvent event) {
  return kEventNames.at(static_cast<std::size_t>(event));
}

}  // namespace hal::routing
