#include "sim/scenario/tally.h"

namespace sim::scenario {

namespace {

constexpr std::array<TallyKind, kTallies> kTallyKinds{{
    {Tally::kFramesSent, "radio", "frames_sent", "1", "frames sent so far, of all kinds"},
    {Tally::kRetries, "radio", "retries", "1", "retransmissions among them"},
    {Tally::kAirtime, "radio", "airtime", "s", "total time on the air of its frames so far"},
    {Tally::kFramesBackground, "radio", "frames_sent.background", "1",
     "QoS data frames among them of user priority 1 or 2"},
    {Tally::kFramesBestEffort, "radio", "frames_sent.best_effort", "1",
     "QoS data frames among them of user priority 0 or 3"},
    {Tally::kFramesVideo, "radio", "frames_sent.video", "1",
     "QoS data frames among them of user priority 4 or 5"},
    {Tally::kFramesVoice, "radio", "frames_sent.voice", "1",
     "QoS data frames among them of user priority 6 or 7"},
    {Tally::kBlockAcks, "radio", "block_acks", "1", "BlockAck frames among them"},
    {Tally::kBlockAckRequests, "radio", "block_ack_requests", "1", "BlockAckReq frames among them"},
    {Tally::kFramesReceived, "radio", "frames_received", "1",
     "frames so far whose payload was passed to the network layer"},
    {Tally::kFramesLost, "radio", "frames_lost", "1",
     "frames so far, addressed to it or to everyone, that it sensed and did not receive"},
    {Tally::kRequestsFailed, "radio", "requests_failed", "1",
     "frames so far that it failed to send: queue full, retry limit, radio off"},
    {Tally::kRssi, "radio", "rssi", "dBm",
     "received power of a frame that was addressed to it or to everyone", true},
    {Tally::kMessagesSent, "messages", "sent", "1",
     "messages to a single agent that its controller has sent so far"},
    {Tally::kMessagesArrived, "messages", "arrived", "1",
     "messages among these that have arrived so far"},
    {Tally::kMessagesReceived, "messages", "received", "1",
     "messages that its controller has received so far, whether sent to it, to everyone or to "
     "neighbours"},
    {Tally::kDelay, "messages", "delay", "s",
     "time from the sending of a message to its reception by this agent's controller; of all "
     "messages that `received` counts",
     true},
    {Tally::kDelayBackground, "messages", "delay.background", "s",
     "the same of messages of user priority 1 or 2", true},
    {Tally::kDelayBestEffort, "messages", "delay.best_effort", "s",
     "the same of messages of user priority 0 or 3", true},
    {Tally::kDelayVideo, "messages", "delay.video", "s",
     "the same of messages of user priority 4 or 5", true},
    {Tally::kDelayVoice, "messages", "delay.voice", "s",
     "the same of messages of user priority 6 or 7", true},
    {Tally::kDiscoveries, "routing", "discoveries", "1",
     "route discoveries so far that found a route"},
    {Tally::kDiscoveriesFailed, "routing", "discoveries_failed", "1",
     "route discoveries so far that were given up"},
    {Tally::kDiscoveryTime, "routing", "discovery_time", "s",
     "duration of a discovery that found a route, from the first message that waited for it", true},
    {Tally::kRouteChanges, "routing", "route_changes", "1",
     "entries of its routing tables added, changed or removed so far"},
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
