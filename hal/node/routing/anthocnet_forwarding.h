#pragma once

#include <tuple>

#include "hal/node/routing/anthocnet_path_setup.h"
#include "hal/node/routing/anthocnet_repair.h"
#include "hal/node/routing/anthocnet_sessions.h"

namespace hal::node::routing::anthocnet {

/// Forwards messages hop by hop to one destination ([PPSN], 3.2). The next hop is drawn by (A5)
/// with beta_data from regular, never virtual, pheromone, and is not the neighbour from which the
/// message came unless there is no other.
///
///   no trail at the source        --> reactive path setup, the message waits
///   no trail at a relay           --> warning to the neighbour that sent it, the message ends
///   the next hop does not answer  --> another trail; without one, the source sets up a new path,
///                                     and a relay starts a repair
class DataForwarding {
 public:
  struct Parts {
    Diffusion& diffusion;
    Backlog& backlog;
    PathSetup& setup;
    Repair& repair;
    Sessions& sessions;
    Losses& losses;
  };

  DataForwarding(AntNode ants, Parts parts) : ants_(ants), parts_(parts) {}

  void send(const Message& message);
  void on_data(Data data, AgentId from);
  /// Result of a message at the link.
  void on_sent(Transit transit, Verdict verdict);
  /// Regular pheromone for the target was laid: sends the messages that wait for it.
  void on_trail(const Target& target);

 private:
  void forward(Transit transit, Verdict verdict_if_exhausted);
  void on_no_trail(Transit transit, bool has_failed);

  AntNode ants_;
  Parts parts_;
  Memory<std::pair<AgentId, Sequence>, Seen> delivered_;
  /// As in Forwarding: a copy that the link delivered twice has the same number of transmissions.
  Memory<std::tuple<AgentId, Sequence, std::uint8_t>, Seen> relayed_;
};

}  // namespace hal::node::routing::anthocnet
