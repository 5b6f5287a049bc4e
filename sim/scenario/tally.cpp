#include "sim/scenario/tally.h"

namespace sim::scenario {

namespace {

constexpr std::array<TallyKind, kTallies> kTallyKinds{{
    {Tally::kFramesSent, "radio", "frames_sent", "1", "frames so far, of all kinds"},
    {Tally::kRetries, "radio", "retries", "1", "of these, sent again"},
    {Tally::kAirtime, "radio", "airtime", "s", "time on the air of its frames so far"},
    {Tally::kFramesReceived, "radio", "frames_received", "1",
     "frames so far whose payload went up to the network layer"},
    {Tally::kFramesLost, "radio", "frames_lost", "1",
     "frames so far for it or for everyone that it noticed and did not receive"},
    {Tally::kRequestsFailed, "radio", "requests_failed", "1",
     "frames so far that it could not send: queue full, retry limit, radio off"},
    {Tally::kRssi, "radio", "rssi", "dBm", "power of a frame for it or everyone that it received",
     true},
    {Tally::kMessagesSent, "messages", "sent", "1",
     "messages so far that its controller sent to one agent"},
    {Tally::kMessagesArrived, "messages", "arrived", "1", "so many of these arrived so far"},
    {Tally::kMessagesReceived, "messages", "received", "1",
     "messages so far that its controller got: to it, to everyone or to neighbours"},
    {Tally::kDelay, "messages", "delay", "s",
     "of a message that its controller got, as `received` counts them, since it was sent", true},
    {Tally::kDiscoveries, "routing", "discoveries", "1", "searches so far that found a route"},
    {Tally::kDiscoveriesFailed, "routing", "discoveries_failed", "1",
     "searches so far that were given up"},
    {Tally::kDiscoveryTime, "routing", "discovery_time", "s",
     "of a search that found a route, since the first message waited for it", true},
    {Tally::kRouteChanges, "routing", "route_changes", "1",
     "entries of its routing tables so far that came, changed or went"},
}};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < kTallies; ++i) {
    const TallyKind& one = kTallyKinds[i];
    if (one.tally != static_cast<Tally>(i) || one.name.empty()) return false;
  }
  return true;
}
static_assert(is_in_order());

}  // namespace

const std::array<TallyKind, kTallies>& tally_kinds() { return kTallyKinds; }

}  // namespace sim::scenario
