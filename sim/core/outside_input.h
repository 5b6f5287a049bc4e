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

/// An input to a run from outside.
struct OutsideArrival {
  /// When the run accepted it: in real time after all events up to and including this time, in
  /// lock-step before the events at this time.
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

  /// Most inputs that wait. Beyond that the oldest is dropped, because the newest command counts.
  static constexpr std::size_t kMostWaiting = 4096;

  /// @throws std::runtime_error  the system cannot create an event descriptor.
  OutsideInput();
  ~OutsideInput();
  OutsideInput(const OutsideInput&) = delete;
  OutsideInput& operator=(const OutsideInput&) = delete;

  /// Before the run. @pre there is no such door yet.
  void open(const std::string& door, Receiver receiver);

  /// Any thread. Ignored in a repetition. @pre the door is open.
  void put(std::string_view door, std::vector<std::uint8_t> bytes);

  /// The same with a simulated time at which the run takes it. These are never dropped. On the
  /// run's thread. @pre times do not decrease.
  void put_at(hal::Time at, std::string_view door, std::vector<std::uint8_t> bytes);

  /// Of put_at(), not taken in yet.
  std::size_t held() const { return held_.size(); }

  /// Readable while something waits.
  int descriptor() const { return descriptor_; }

  /// Whether take() would hand something over.
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
