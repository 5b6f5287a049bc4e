#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hal/exchange/ports.h"
#include "hal/exchange/session.h"

namespace gateway {

/// Who gets which agent. Rules only: no DDS, no clock, no log.
///
/// A Hello is granted every agent that one of its patterns fits, or is refused as a whole. Refused
/// are: another protocol version; no patterns; a process name that a granted process has; a
/// pattern that fits no agent; an agent that is taken, that the scenario gives to another program,
/// that is of a kind the program does not drive, or that lacks a channel the program needs; and
/// everyone, once closed. Where others have agents, too, who asks for none of these is no
/// business of this server.
class Admission {
 public:
  /// Whose agents these are. kSome: other servers of the domain have more, so that of several
  /// patterns of a process one is enough that fits an agent.
  enum class Offered : std::uint8_t { kAll, kSome };

  Admission(std::vector<hal::exchange::AgentOffer> offers, std::uint64_t run,
            Offered offered = Offered::kAll);

  /// The Session for a Hello; `refusal` says why not. `server` is left empty. A Hello that was
  /// granted before gets the same Session again.
  hal::exchange::Session decide(const hal::exchange::Hello& hello);

  /// Whether the Hello is to be left to other servers.
  bool is_for_others(const hal::exchange::Hello& hello) const;

  void release(const std::string& instance);  ///< Its agents are free again.
  void close() { closed_ = true; }            ///< The run begins: nobody joins.

  bool is_complete() const;
  /// Agents without a controller, by address.
  std::vector<hal::AgentId> free_agents() const;
  /// Agents without a controller, with the program that should drive them if it is named:
  /// "m1 (help_mote)".
  std::vector<std::string> missing() const;

 private:
  struct Place {
    hal::exchange::AgentOffer offer;
    std::string holder;  ///< Instance; empty: free.
  };
  std::string refusal_of(const hal::exchange::Hello& hello) const;
  /// Calls visit(place) for each one that the pattern fits.
  template <class Visit>
  void for_each_fit(const std::string& pattern, Visit visit) const;
  bool fits_one(const std::string& pattern) const;
  /// Indices in places_ of those that are asked for, ascending.
  std::vector<std::size_t> asked_for(const hal::exchange::Hello& hello) const;
  std::string unknown_in(const hal::exchange::Hello& hello) const;
  std::string objection(const Place& place, const hal::exchange::Hello& hello) const;
  hal::exchange::Session grant(const hal::exchange::Hello& hello);

  std::vector<Place> places_;                              ///< By address.
  std::map<std::string, std::size_t> by_name_;             ///< Indices in places_.
  std::map<std::string, hal::exchange::Session> granted_;  ///< By instance.
  std::map<std::string, std::string> process_names_;       ///< By instance.
  std::uint64_t run_;
  Offered offered_;
  bool closed_ = false;
};

}  // namespace gateway
