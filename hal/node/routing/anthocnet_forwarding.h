#pragma once

#include <tuple>

#include "hal/node/routing/anthocnet_path_setup.h"
#include "hal/node/routing/anthocnet_repair.h"
#include "hal/node/routing/anthocnet_sessions.h"

namespace hal::node::routing::anthocnet {

/// Takes messages hop by hop to one destination ([PPSN], 3.2): the next hop is drawn by regular
/// pheromone to the power of beta_data, never virtual, and not back to where the message came from
/// unless there is no other.
///
///   no trail at the source        --> reactive path setup, the message waits
///   no trail at a relay           --> warning to the neighbour that sent it, the message ends
///   the next hop does not answer  --> another trail; else the source sets up a path anew, and a
///                                     relay repairs
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
  /// How the link did with a message.
  void on_sent(Transit transit, Verdict verdict);
  /// Regular pheromone for the target is there: sends what waited for it.
  void on_trail(const Target& target);

 private:
  void forward(Transit transit, Verdict verdict_if_exhausted);
  void on_no_trail(Transit transit, bool has_failed);

  AntNode ants_;
  Parts parts_;
  Memory<std::pair<AgentId, Sequence>, Seen> delivered_;
  /// As in Forwarding: a copy that the link gave us twice repeats the number of transmissions.
  Memory<std::tuple<AgentId, Sequence, std::uint8_t>, Seen> relayed_;
};

}  // namespace hal::node::routing::anthocnet
