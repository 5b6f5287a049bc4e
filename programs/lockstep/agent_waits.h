#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "programs/lockstep/kernel_thread.h"
#include "programs/lockstep/processor_charge.h"
#include "programs/netns/descriptor.h"
#include "programs/netns/wait_page.h"

namespace programs::lockstep {

/// The programs of one agent in lock-step, as the run sees them: gives them the virtual time, lets
/// one thread at a time go on until all wait, and ends the waits whose deadline has come. One
/// thread.
///
///   waits.set_time(now);
///   while (waits.expire()) waits.settle();
///   waits.settle();                  // all wait again
///   next = waits.deadline();
class AgentWaits {
 public:
  struct Settings {
    std::string agent;                ///< Its name, for messages.
    netns::FileDescriptor processes;  ///< Its namespace of process numbers.
    bool allow_unknown = false;       ///< A thread that waits in an unknown call counts as waiting.
    std::int64_t per_wake = 0;  ///< Virtual time that the processor takes before each turn, ns.
    /// Called every 50 ms of wall time while programs run. @return false: the run is broken off.
    std::function<bool()> may_go_on;
    std::function<void(const std::string&)> warn;
  };

  /// Whether turns cost Settings::per_wake.
  enum class Turns : std::uint8_t { kCharged, kFree };

  /// @param page  outlives this; no program has it yet.
  AgentWaits(netns::WaitPage& page, Settings settings);

  /// Virtual time, ns. Never decreases.
  void set_time(std::int64_t now);

  /// Reserves a slot for a program that is about to be started: the value of kSlotVariable.
  std::size_t reserve();
  /// The program of a reserved slot has started, or could not be.
  void started(std::size_t slot, pid_t process);
  void not_started(std::size_t slot);

  /// Ends the waits, and lets the timers expire, whose deadline is not after the virtual time. One
  /// signal at a time for each process: which of two pending ones it takes first is the kernel's
  /// affair. @return whether timers are left, which are to expire once all wait again.
  bool expire();

  /// Lets threads that want to go on do so, the one with the lowest slot first, until all wait, or
  /// for the processor.
  /// @return false: broken off. @throws std::runtime_error  a thread waits in an unknown call, or a
  ///   program did not load the library.
  bool settle(Turns turns = Turns::kCharged);

  /// The earliest deadline; none: nothing is to come.
  std::optional<std::int64_t> deadline() const;

  /// Differs from before if a thread has begun, gone on or waited in the meantime.
  std::uint32_t changes() const { return page_.event.load(); }

  /// Whether threads wait for room in the station's queue; and makes them go on.
  bool waits_for_room() const { return is_one_waiting(netns::kRoomObject); }
  /// @return whether there were any.
  bool wake_for_room();
  /// Whether threads wait until the kernel takes what they send or write.
  bool waits_to_send() const { return is_one_waiting(netns::kSendingObject); }

  /// The run is over, maybe broken off: Settings::may_go_on is asked anew.
  void begin_to_end() { is_broken_off_ = false; }

  /// Processes that run, by their numbers inside.
  std::set<pid_t> processes() const;
  /// Sends a signal to one of them, and wakes it if it is stopped. Handlers that run at once are
  /// over when this returns. @pre all wait: settle().
  void send(pid_t process, int signal);

  /// Nobody waits for a turn any more: programs go on and end as they like.
  void let_go();

  /// Slots of reserve() whose process has ended since the last call.
  std::vector<std::size_t> take_ended();

  struct Counts {
    std::uint64_t turns = 0;    ///< Threads let go on.
    std::uint64_t looks = 0;    ///< At what the kernel says.
    std::uint64_t expired = 0;  ///< Waits and timers.
    std::uint64_t unknown = 0;  ///< Waits in unknown calls.
  };
  const Counts& counts() const { return counts_; }
  /// Times that a thread that only looked at the clock was made to sleep.
  std::uint64_t spins() const { return page_.spins.load(); }

 private:
  struct Thread {
    KernelThread kernel;
    pid_t number = 0;  ///< Inside, of whom `kernel` is.
    /// Of the last wait in which the kernel said that it sleeps. Before that, a handler of a signal
    /// would run ahead of the wait that it is to interrupt.
    std::uint64_t ticket = 0;
    std::int64_t asleep_since = 0;  ///< Wall time, ns: in an unknown call; 0: it is not.
    bool is_in_unknown_call = false;
    bool is_program = false;  ///< Reserved for a program of the scenario.
  };

  netns::WaitSlot& slot(std::size_t i) { return page_.slots[i]; }
  std::size_t used() const { return page_.used.load(); }
  bool is_one_waiting(std::uint64_t object) const;
  KernelState look(std::size_t i);
  bool is_one_running(std::uint32_t seen);
  void look_at_running(std::size_t i);
  /// Until it waits again, or its call ends.
  void go_on_without(std::size_t i);
  bool is_in_unknown_call(std::size_t i);
  /// Whether only the kernel knows if a thread that has published a wait is asleep.
  bool is_to_be_seen(std::size_t i, bool looks_at_parked, bool is_stirred) const;
  bool are_all_asleep();
  bool is_asleep(std::size_t i);
  bool release_ended();
  bool is_unsettled(std::uint32_t seen);
  void release(std::size_t i);
  void release_timers(pid_t process);
  /// Whose turn is next; none: nobody's, or the processor is busy until deadline().
  std::optional<std::size_t> next_turn(Turns turns);
  void grant(std::size_t i);
  void see_all_asleep();
  void fire(std::size_t i);
  void expire_wait(std::size_t i);
  void end_wait(std::size_t i);
  bool wake(std::uint64_t object);
  void wait_for_event(std::uint32_t seen, std::int64_t longest);
  bool is_broken_off();
  bool is_broken_off_meanwhile();
  void warn_of_long_run();

  netns::WaitPage& page_;
  Settings settings_;
  AgentTasks tasks_;
  std::array<Thread, netns::WaitPage::kSlots> threads_;
  std::vector<std::size_t> ended_;
  ProcessorCharge charge_;
  bool has_seen_awake_ = false;  ///< A thread that was looked at by are_all_asleep().
  /// Threads that wait in the kernel may have been woken since they were last looked at: by the
  /// run, or by system calls of the programs, WaitPage::stirs.
  bool is_stirred_ = true;
  std::uint32_t stirs_ = 0;
  /// A signal was sent: handlers may run in threads that are parked, or want to go on.
  bool looks_at_parked_ = false;
  std::uint32_t signals_ = 0;                      ///< As WaitPage::signals was.
  std::int64_t running_since_ = 0, asked_at_ = 0;  ///< Wall time, ns.
  bool has_warned_ = false, is_broken_off_ = false;
  Counts counts_;
};

}  // namespace programs::lockstep
