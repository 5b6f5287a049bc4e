#pragma once

#include <functional>
#include <map>
#include <optional>

#include "hal/node/routing/aodv_search.h"
#include "hal/node/routing/aodv_table.h"

namespace hal::node::routing {

/// Hellos of AODV (RFC 3561, section 6.9): a node on an active route that broadcast nothing for
/// HELLO_INTERVAL broadcasts its own address and number. A neighbour that sent one, and then
/// nothing at all for ALLOWED_HELLO_LOSS intervals, is lost.
///
/// Each interval is shortened by a random quarter at most (RFC 5148, 5.1: or neighbours that
/// started together would collide for ever), and half of one is added to what a neighbour has.
class AodvHellos {
 public:
  /// @param on_silence  called once when a neighbour is lost.
  AodvHellos(Node& node, const AodvTable& table, const AodvSearch& search, Outbox& outbox,
             std::function<void(AgentId)> on_silence);

  /// Sends the first hello after a random part of the interval.
  void start();
  void on_broadcast() { last_broadcast_ = node_.now(); }
  void on_hello(AgentId from);
  /// Any frame is a sign of life.
  void on_heard(AgentId from);
  void forget(AgentId neighbour) { last_heard_.erase(neighbour); }

  /// How long a neighbour may be silent.
  Duration patience() const;

 private:
  void on_interval();
  void check();

  Node& node_;
  const AodvTable& table_;
  const AodvSearch& search_;
  Outbox& outbox_;
  std::function<void(AgentId)> on_silence_;
  std::optional<Time> last_broadcast_;
  std::map<AgentId, Time> last_heard_;  ///< Of neighbours that sent a hello.
};

}  // namespace hal::node::routing
