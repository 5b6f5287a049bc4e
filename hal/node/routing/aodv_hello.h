#pragma once

#include <functional>
#include <map>
#include <optional>

#include "hal/node/routing/aodv_search.h"
#include "hal/node/routing/aodv_table.h"

namespace hal::node::routing {

/// Hellos of AODV (RFC 3561, section 6.9): a node on an active route that has broadcast nothing for
/// HELLO_INTERVAL broadcasts its own address and sequence number. A neighbour that sent a hello,
/// and then no frame at all for ALLOWED_HELLO_LOSS intervals, is lost.
///
/// Each interval is shortened at random by up to a quarter (RFC 5148, 5.1: otherwise the hellos of
/// neighbours that started together would always collide), and a neighbour gets an extra half
/// interval.
class AodvHellos {
 public:
  /// @param on_silence  called once when a neighbour is lost.
  AodvHellos(Node& node, const AodvTable& table, const AodvSearch& search, Outbox& outbox,
             std::function<void(AgentId)> on_silence);

  /// Sends the first hello after a random part of the interval.
  void start();
  void on_broadcast() { last_broadcast_ = node_.now(); }
  void on_hello(AgentId from);
  /// Any frame shows that its transmitter is alive.
  void on_heard(AgentId from);
  void forget(AgentId neighbour) { last_heard_.erase(neighbour); }

  /// Longest permitted silence of a neighbour.
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
  std::map<AgentId, Time> last_heard_;  ///< Only neighbours that sent a hello.
};

}  // namespace hal::node::routing
