#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hal/node/exchange/ports.h"
#include "hal/node/exchange/session.h"

namespace gateway::server {

/// Assigns agents to processes. Rules only: no DDS, no clock, no log.
///
/// A Hello is granted every agent that one of its patterns matches, or is refused as a whole.
/// Reasons to refuse are: another protocol version; no patterns; a process name that a granted
/// process has; a pattern that matches no agent; an agent that is taken, that the scenario assigns
/// to another program, that is of a kind the program does not control, or that lacks a channel the
/// program requires; and any Hello after close(). Where other servers have agents, too, a Hello
/// that matches none of this server's is left to them.
class Admission {
 public:
  /// Which of the domain's agents this server has. kSome: other servers of the domain have more, so
  /// it suffices that one of several patterns of a process matches an agent.
  enum class Offered : std::uint8_t { kAll, kSome };

  Admission(std::vector<hal::node::exchange::AgentOffer> offers, std::uint64_t run,
            Offered offered = Offered::kAll);

  /// The Session for a Hello; `refusal` is the reason if it is refused. `server` is left empty. A
  /// Hello that was granted before gets the same Session again.
  hal::node::exchange::Session decide(const hal::node::exchange::Hello& hello);

  /// Whether the Hello should be left to other servers.
  bool is_for_others(const hal::node::exchange::Hello& hello) const;

  void release(const std::string& instance);  ///< Frees its agents.
  void close() { closed_ = true; }            ///< The run begins: later Hellos are refused.

  bool is_complete() const;
  /// Agents without a controller, sorted by address.
  std::vector<hal::AgentId> free_agents() const;
  /// Agents without a controller, with the program that should drive them if it is named: "m1
  /// (help_mote)".
  std::vector<std::string> missing() const;

 private:
  struct Place {
    hal::node::exchange::AgentOffer offer;
    std::string holder;  ///< Instance id; empty: free.
  };
  std::string refusal_of(const hal::node::exchange::Hello& hello) const;
  /// Calls visit(place) for each agent that the pattern matches.
  template <class Visit>
  void for_each_fit(const std::string& pattern, Visit visit) const;
  bool fits_one(const std::string& pattern) const;
  /// Indices in places_ of the agents that a Hello asks for, in ascending order.
  std::vector<std::size_t> asked_for(const hal::node::exchange::Hello& hello) const;
  std::string unknown_in(const hal::node::exchange::Hello& hello) const;
  std::string objection(const Place& place, const hal::node::exchange::Hello& hello) const;
  hal::node::exchange::Session grant(const hal::node::exchange::Hello& hello);

  std::vector<Place> places_;                                    ///< By address.
  std::map<std::string, std::size_t> by_name_;                   ///< Indices in places_.
  std::map<std::string, hal::node::exchange::Session> granted_;  ///< By instance.
  std::map<std::string, std::string> process_names_;             ///< By instance.
  std::uint64_t run_;
  Offered offered_;
  bool closed_ = false;
};

}  // namespace gateway::server
