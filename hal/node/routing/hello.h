#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "hal/node/routing/frame.h"
#include "hal/node/routing/node.h"

namespace hal::node::routing {

/// Announces this node to its neighbours, and detects neighbours that become silent. A MAC with
/// transmit status detects that only when a frame to the neighbour fails.
///
/// A hello is broadcast every hello_period, shortened at random by up to a quarter (RFC 5148, 5.1:
/// otherwise the hellos of neighbours that started together would always collide). Any frame shows
/// that its transmitter is alive. A neighbour is lost when it was silent for hello_limit periods,
/// as stated in its hellos, plus half a period for the delay of the last (G. Di Caro, F. Ducatelle,
/// L. Gambardella,
/// "AntHocNet", 2005: two missed hellos; hold times as in RFC 6130, 5.4.1).
class Hellos {
 public:
  /// @param on_silence  called once when a neighbour is lost.
  Hellos(Node& node, Link& link, std::function<void(AgentId)> on_silence);

  /// Sends the first hello after a random part of the period.
  void start();

  void on_heard(AgentId from);
  void on_hello(AgentId from, const Hello& hello);

 private:
  struct Watch {
    AgentId neighbour;
    Time last_heard{};
    Duration period{};
  };

  void schedule_next();
  Time deadline(const Watch& watch) const;
  Watch& watch_of(AgentId neighbour);
  void wait_for(const Watch& watch);
  void wait_until(Time deadline);
  void on_deadline();

  Node& node_;
  Link& link_;
  std::function<void(AgentId)> on_silence_;
  std::vector<Watch> watched_;   ///< By address.
  std::optional<Time> wake_at_;  ///< When the timer fires; nullopt: it is not set.
  OwnTimers::Handle timer_ = 0;
};

}  // namespace hal::node::routing
