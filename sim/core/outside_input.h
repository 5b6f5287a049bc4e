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

/// One input from outside the run.
struct OutsideArrival {
  /// When the run accepted it. Real time: after all events up to and including this time.
  /// Lock-step: before the events at this time.
  hal::Time at{};
  std::string door;  ///< Name of the receiver: "cmd_vel of r0".
  std::vector<std::uint8_t> bytes;
  bool operator==(const OutsideArrival&) const = default;
};

/// The only way for input from outside into a run: velocities from teleoperation, and everything
/// else that the scenario and its seed do not determine. Input waits here until the run takes it
/// between two events. It is recorded with that time, and a repetition takes it at the same time.
///
///   input.open("cmd_vel of r0", receiver);    // before the run
///   input.put("cmd_vel of r0", bytes);        // any thread
///   input.take(now, [&](const OutsideArrival& arrival) { record(arrival); });
///
/// The scenario determines which doors are open, so a repetition has the same ones.
class OutsideInput {
 public:
  /// Called on the run's thread, between events.
  using Receiver = std::function<void(std::span<const std::uint8_t>)>;

  /// Largest number of waiting inputs. Beyond it the oldest is dropped, because the newest command
  /// counts.
  static constexpr std::size_t kMostWaiting = 4096;

  /// @throws std::runtime_error  the system cannot create an event descriptor.
  OutsideInput();
  ~OutsideInput();
  OutsideInput(const OutsideInput&) = delete;
  OutsideInput& operator=(const OutsideInput&) = delete;

  /// Opens a door. Call before the run. @pre there is no such door yet.
  void open(const std::string& door, Receiver receiver);

  /// On the run's thread, during it.
  bool is_open(std::string_view door) const { return doors_.contains(door); }

  /// Adds an input. Any thread. Ignored in a repetition. @pre the door is open.
  void put(std::string_view door, std::vector<std::uint8_t> bytes);

  /// Adds an input that the run takes at a given simulated time. Such inputs are never dropped.
  /// Call on the run's thread. @pre times do not decrease.
  void put_at(hal::Time at, std::string_view door, std::vector<std::uint8_t> bytes);

  /// Hands an input to the door's receiver at once: one of programs in lock-step, which act in an
  /// event of the run. On the run's thread. @pre the door is open.
  void hand_over(const OutsideArrival& arrival);

  /// Of put_at(), not taken in yet.
  std::size_t held() const { return held_.size(); }

  /// File descriptor that is readable while an input waits.
  int descriptor() const { return descriptor_; }

  /// Whether take() would pass on an input.
  bool has_due(hal::Time now) const;

  /// Passes on inputs with a time up to `now`, then those that wait, in order of arrival; in a
  /// repetition, the recorded ones up to `now`.
  /// @param seen  called for each input before its receiver.
  /// @returns whether there was any input.
  bool take(hal::Time now, const std::function<void(const OutsideArrival&)>& seen);

  /// From now on only these inputs are accepted. Call after open().
  /// @param arrivals  by time.
  /// @throws std::runtime_error  one is for a door that is not open.
  void replay(std::vector<OutsideArrival> arrivals);

  /// Time of the next input with a time: of a repetition, or of put_at().
  std::optional<hal::Time> next_due() const;

  /// Number of inputs that were dropped because too many waited. Any thread.
  std::uint64_t dropped() const { return dropped_; }

 private:
  std::deque<OutsideArrival> due(hal::Time now);

  std::map<std::string, Receiver, std::less<>> doors_;
  std::mutex mutex_;  ///< Guards doors_ until the run begins, waiting_ until replay().
  std::deque<OutsideArrival> waiting_;
  std::deque<OutsideArrival> held_;       ///< Inputs of put_at().
  std::atomic<bool> has_waiting_{false};  ///< Saves the lock at each instant of lock-step.
  std::atomic<bool> is_replayed_{false};
  std::atomic<std::uint64_t> dropped_{0};
  std::uint64_t told_ = 0;  ///< Number of dropped inputs that the log has reported.
  int descriptor_ = -1;
};

}  // namespace sim
