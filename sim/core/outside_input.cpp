#include "sim/core/outside_input.h"

#include <fmt/format.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "hal/types/check.h"
#include "hal/types/log.h"

namespace sim {

OutsideInput::OutsideInput() : descriptor_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (descriptor_ >= 0) return;
  throw std::runtime_error(fmt::format("input from outside: {}", std::strerror(errno)));
}

OutsideInput::~OutsideInput() { ::close(descriptor_); }

void OutsideInput::open(const std::string& door, Receiver receiver) {
  const std::lock_guard lock(mutex_);  // Doors that are already open may receive input.
  BARAKA_CHECK(doors_.emplace(door, std::move(receiver)).second);
}

void OutsideInput::put(std::string_view door, std::vector<std::uint8_t> bytes) {
  if (is_replayed_) return;
  {
    const std::lock_guard lock(mutex_);
    BARAKA_CHECK(doors_.contains(door));
    if (waiting_.size() == kMostWaiting) {
      waiting_.pop_front();
      ++dropped_;
    }
    waiting_.push_back({.door = std::string(door), .bytes = std::move(bytes)});
    has_waiting_ = true;
  }
  ::eventfd_write(descriptor_, 1);
}

void OutsideInput::put_at(hal::Time at, std::string_view door, std::vector<std::uint8_t> bytes) {
  if (is_replayed_) return;
  BARAKA_CHECK(doors_.contains(door) && (held_.empty() || held_.back().at <= at));
  held_.push_back({.at = at, .door = std::string(door), .bytes = std::move(bytes)});
}

void OutsideInput::hand_over(const OutsideArrival& arrival) {
  const auto door = doors_.find(arrival.door);
  BARAKA_CHECK(door != doors_.end());
  door->second(arrival.bytes);
}

bool OutsideInput::has_due(hal::Time now) const {
  if (is_replayed_) return has_waiting_ && waiting_.front().at <= now;
  return has_waiting_ || (!held_.empty() && held_.front().at <= now);
}

std::deque<OutsideArrival> OutsideInput::due(hal::Time now) {
  const auto until_now = [now](std::deque<OutsideArrival>& from) {
    std::deque<OutsideArrival> arrivals;
    const auto later = std::ranges::find_if(from, [&](const auto& a) { return a.at > now; });
    std::move(from.begin(), later, std::back_inserter(arrivals));
    from.erase(from.begin(), later);
    return arrivals;
  };
  if (!is_replayed_) {
    std::deque<OutsideArrival> arrivals = until_now(held_);
    if (!has_waiting_) return arrivals;
    const std::lock_guard lock(mutex_);
    eventfd_t count = 0;
    ::eventfd_read(descriptor_, &count);
    for (OutsideArrival& arrival : std::exchange(waiting_, {})) {
      arrival.at = now;
      arrivals.push_back(std::move(arrival));
    }
    has_waiting_ = false;
    return arrivals;
  }
  const std::lock_guard lock(mutex_);
  std::deque<OutsideArrival> arrivals = until_now(waiting_);
  has_waiting_ = !waiting_.empty();
  return arrivals;
}

bool OutsideInput::take(hal::Time now, const std::function<void(const OutsideArrival&)>& seen) {
  if (!has_waiting_ && held_.empty()) return false;
  const std::deque<OutsideArrival> arrivals = due(now);
  if (const std::uint64_t dropped = dropped_; dropped != told_) {
    hal::log::warning(now, "run",
                      "{} inputs from outside dropped, oldest first: at most {} may wait",
                      dropped - told_, kMostWaiting);
    told_ = dropped;
  }
  for (const OutsideArrival& arrival : arrivals) {
    seen(arrival);
    doors_.find(arrival.door)->second(arrival.bytes);
  }
  return !arrivals.empty();
}

void OutsideInput::replay(std::vector<OutsideArrival> arrivals) {
  for (const OutsideArrival& arrival : arrivals) {
    if (doors_.contains(arrival.door)) continue;
    throw std::runtime_error(
        fmt::format("the record has an input from outside for '{}', which this run does not have",
                    arrival.door));
  }
  is_replayed_ = true;
  const std::lock_guard lock(mutex_);
  waiting_.assign(std::make_move_iterator(arrivals.begin()),
                  std::make_move_iterator(arrivals.end()));
  has_waiting_ = !waiting_.empty();
}

std::optional<hal::Time> OutsideInput::next_due() const {
  const std::deque<OutsideArrival>& timed = is_replayed_ ? waiting_ : held_;
  if (timed.empty()) return std::nullopt;
  return timed.front().at;
}

}  // namespace sim
