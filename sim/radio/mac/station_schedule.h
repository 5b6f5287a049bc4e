#pragma once

#include <deque>
#include <map>
#include <optional>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace sim::radio {

/// Whose turn it is among the receivers that one access category has something for: in turn, or by
/// deficit round robin over airtime, in which receivers that had nothing before come first (T.
/// Hoeiland-Joergensen, M. Kazior, D. Taht, P. Hurtig, A. Brunstrom, "Ending the Anomaly: Achieving
/// Low Latency and Airtime Fairness in WiFi", USENIX ATC 2017, algorithm 3).
class StationSchedule {
 public:
  /// @param quantum  airtime of a turn; nullopt: a turn is one exchange.
  explicit StationSchedule(std::optional<hal::Duration> quantum) : quantum_(quantum) {}

  /// There is something for this receiver.
  void add(hal::AgentId receiver);
  /// The receiver whose turn it is. @param has_work  (AgentId) -> whether there still is something.
  template <class HasWork>
  std::optional<hal::AgentId> next(HasWork has_work) {
    while (!new_.empty() || !old_.empty()) {
      const bool is_new = !new_.empty();
      std::deque<hal::AgentId>& list = is_new ? new_ : old_;
      const hal::AgentId receiver = list.front();
      Share& share = shares_[receiver];
      const bool is_due = share.deficit > hal::Duration{};
      if (is_due && has_work(receiver)) return receiver;
      list.pop_front();
      if (!is_due) share.deficit += quantum_.value_or(kOneExchange);
      // What was new takes a turn among the old before it may be new again.
      share.is_listed = !is_due || is_new;
      if (share.is_listed) old_.push_back(receiver);
    }
    return std::nullopt;
  }
  /// Airtime of an exchange with a receiver, or of what it sent.
  void charge(hal::AgentId receiver, hal::Duration airtime);
  /// Whether received frames are to be charged, too.
  bool is_of_airtime() const { return quantum_.has_value(); }

 private:
  static constexpr hal::Duration kOneExchange{1};
  struct Share {
    hal::Duration deficit{kOneExchange};  ///< Airtime that is left.
    bool is_listed = false;               ///< In new_ or old_.
  };

  std::optional<hal::Duration> quantum_;
  std::map<hal::AgentId, Share> shares_;
  std::deque<hal::AgentId> new_, old_;
};

}  // namespace sim::radio
