#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

#include "hal/types/check.h"
#include "hal/types/time.h"
#include "sim/radio/mac/mac_sap.h"
#include "sim/radio/mac/sequence_number.h"

namespace sim::radio {

/// A request to be transmitted.
struct Outgoing {
  MacRequest request;
  std::uint16_t sequence = 0;  ///< 0..4095, IEEE Std 802.11-2016, 9.2.4.4.
  hal::Time queued{};          ///< Time of arrival at this station.
  std::uint32_t attempts = 0;  ///< Number of times that its data frame has been sent.
  bool is_numbered = false;    ///< QoS data: `sequence` is that of its receiver and TID.

  bool is_broadcast() const { return request.destination == hal::kEveryone; }
  bool is_management() const { return radio::is_management(request.header.type); }
};

/// Queue of the requests of one contention function, first in, first out; the head is the one in
/// service.
class TxQueue {
 public:
  explicit TxQueue(std::size_t limit) : limit_(limit) {}

  bool is_full() const { return queue_.size() >= limit_; }
  bool is_empty() const { return queue_.empty(); }
  std::size_t room() const { return limit_ - std::min(limit_, queue_.size()); }
  std::size_t size() const { return queue_.size(); }

  /// @pre not full.
  void push(const MacRequest& request, hal::Time now) {
    BARAKA_CHECK(!is_full());
    if (queue_.empty()) head_since_ = now;
    queue_.push_back({request, next_sequence_, request.header.since.value_or(now), 0});
    next_sequence_ = later(next_sequence_, 1);
  }
  /// The same of a request that has been queued elsewhere, whatever the limit.
  void put(Outgoing outgoing, hal::Time now) {
    if (queue_.empty()) head_since_ = now;
    outgoing.sequence = next_sequence_;
    queue_.push_back(std::move(outgoing));
    next_sequence_ = later(next_sequence_, 1);
  }
  /// Puts a request of the MAC itself before all others, whatever the limit.
  void push_front(const MacRequest& request, hal::Time now) {
    head_since_ = now;
    queue_.push_front({request, next_sequence_, now, 0});
    next_sequence_ = later(next_sequence_, 1);
  }

  Outgoing& head() { return queue_.front(); }
  const Outgoing& head() const { return queue_.front(); }
  Outgoing& at(std::size_t place) { return queue_[place]; }
  /// Time at which the head reached the front.
  hal::Time head_since() const { return head_since_; }

  /// @pre not empty.
  MacRequest pop(hal::Time now) {
    MacRequest request = std::move(queue_.front().request);
    queue_.pop_front();
    head_since_ = now;
    return request;
  }
  /// Takes out the request at a place.
  Outgoing take(std::size_t place, hal::Time now) {
    Outgoing taken = std::move(queue_[place]);
    queue_.erase(queue_.begin() + static_cast<std::ptrdiff_t>(place));
    if (place == 0) head_since_ = now;
    return taken;
  }

  std::deque<Outgoing> take_all() { return std::exchange(queue_, {}); }

 private:
  std::size_t limit_;
  std::deque<Outgoing> queue_;
  hal::Time head_since_{};
  std::uint16_t next_sequence_ = 0;
};

}  // namespace sim::radio
