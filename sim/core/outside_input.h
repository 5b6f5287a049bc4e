#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/time.h"

namespace sim {

/// Something that came into a run from outside.
struct OutsideArrival {
  /// When the run took it in: in real time all events up to and including this time had run, in
  /// lock-step those at this time were about to.
  hal::Time at{};
  std::string door;  ///< What it is for: "cmd_vel of r0".
  std::vector<std::uint8_t> bytes;
  bool operator==(const OutsideArrival&) const = default;
};

/// The one way by which anything from outside enters a run: velocities by hand, and whatever else
/// does not follow from the scenario and its seed. It waits here until the run, between two events,
/// takes it in; then the record has it with its time, and a repetition takes in the same.
///
///   input.open("cmd_vel of r0", receiver);    // before the run
///   input.put("cmd_vel of r0", bytes);        // any thread
///   input.take(now, [&](const OutsideArrival& arrival) { record(arrival); });
///
/// Which doors are open follows from the scenario; so a repetition has the same.
class OutsideInput {
 public:
  /// Called on the run's thread, between events.
  using Receiver = std::function<void(std::span<const std::uint8_t>)>;

  /// Waiting at most. When more comes, the oldest goes: the newest command counts.
  static constexpr std::size_t kMostWaiting = 4096;

  /// @throws std::runtime_error  the system has no event descriptor left.
  OutsideInput();
  ~OutsideInput();
  OutsideInput(const OutsideInput&) = delete;
  OutsideInput& operator=(const OutsideInput&) = delete;

  /// Before the run. @pre there is no such door yet.
  void open(const std::string& door, Receiver receiver);

  /// Any thread. Ignored in a repetition. @pre the door is open.
  void put(std::string_view door, std::vector<std::uint8_t> bytes);

  /// The same of something that came at a time of the run: it is taken in then. None of these goes,
  /// however many wait. On the run's thread. @pre not before the one before it.
  void put_at(hal::Time at, std::string_view door, std::vector<std::uint8_t> bytes);

  /// Of put_at(), not taken in yet.
  std::size_t held() const { return held_.size(); }

  /// Readable while something waits.
  int descriptor() const { return descriptor_; }

  /// Whether take() would hand something over.
  bool has_due(hal::Time now) const;

  /// Hands over what waits, in the order it came, after what came at a time until `now`; in a
  /// repetition, what was taken in until `now`.
  /// @param seen  told of each before its receiver is.
  /// @returns whether there was anything.
  bool take(hal::Time now, const std::function<void(const OutsideArrival&)>& seen);

  /// From now on nothing comes but these. After open().
  /// @param arrivals  by time.
  /// @throws std::runtime_error  one is for a door that is not open.
  void replay(std::vector<OutsideArrival> arrivals);

  /// When the next is due of those that have a time: of a repetition, or of put_at().
  std::optional<hal::Time> next_due() const;

  /// What was put and never taken in, because too much waited. Any thread.
  std::uint64_t dropped() const { return dropped_; }

 private:
  std::deque<OutsideArrival> due(hal::Time now);

  std::map<std::string, Receiver, std::less<>> doors_;
  std::mutex mutex_;  ///< Of doors_ until the run begins, of waiting_ until replay().
  std::deque<OutsideArrival> waiting_;
  std::deque<OutsideArrival> held_;       ///< Of put_at().
  std::atomic<bool> has_waiting_{false};  ///< Saves the lock at each instant of lock-step.
  std::atomic<bool> is_replayed_{false};
  std::atomic<std::uint64_t> dropped_{0};
  std::uint64_t told_ = 0;  ///< Of those dropped, in the log.
  int descriptor_ = -1;
};

}  // namespace sim
