#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace programs::netns {

/// Present in the environment of a program in lock-step: the number of the slot that was reserved
/// for it in its agent's WaitPage.
inline constexpr const char* kSlotVariable = "BARAKA_SLOT";

/// The signal by which the run ends a wait in the kernel whose deadline has come.
inline constexpr int kEndWait = 63;

/// A deadline that never comes.
inline constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

/// WaitSlot::object of a thread that waits for room in the queue of the agent's station: the run
/// makes it go on when there may be some.
inline constexpr std::uint64_t kRoomObject = 2;

/// The same of one that waits, in the kernel, until it can send or write: it can when the run has
/// taken frames from the agent's interface.
inline constexpr std::uint64_t kSendingObject = 5;

/// The same of one that waits for a lock of a file, which is free, too, when a process ends.
inline constexpr std::uint64_t kFileLockObject = 6;

/// WaitSlot::expired of a wait that another thread has interrupted.
inline constexpr std::uint32_t kInterrupted = 2;

/// WaitSlot::thread of a thread of `process` that has not begun.
inline constexpr std::int32_t kNewThread = -1;

/// What a slot of a WaitPage says of its thread. The thread itself writes it, except where noted.
enum class SlotState : std::uint32_t {
  kFree,      ///< Names no thread. Written by the run.
  kExpected,  ///< A process that is being started; it takes the slot over when it is loaded.
  kRunning,   ///< Runs, or a call that is not known to wait holds it. Given by the run.
  kWaiting,   ///< Waits for what `kind` says, until `deadline` at the latest.
  kWants,     ///< Has to go on: its wait has ended, or it is new. Waits for `grant`.
  kEnding,    ///< The thread is about to end; free once the kernel no longer knows it.
  kTimer,     ///< No thread: a timer, which the run lets expire at `deadline`.
  kUnknown,  ///< Waits in a call that is not known to wait. Given by the run where that is allowed.
};

/// What a thread waits for.
enum class WaitKind : std::uint32_t {
  kParked,   ///< For `grant` alone: another thread of the agent, or its deadline, makes it go on.
  kInKernel  ///< In a system call that the kernel, or a signal of the run, ends.
};

/// One thread of a program, or one of its timers.
struct alignas(64) WaitSlot {
  std::atomic<SlotState> state;
  std::atomic<WaitKind> kind;
  std::atomic<std::uint32_t> grant;    ///< A futex; 1: the thread may go on. Set by the run.
  std::atomic<std::uint32_t> expired;  ///< 1: its deadline has come. Set by the run. kInterrupted.
  std::atomic<std::int32_t> process;   ///< Numbers inside the agent; 0: not known yet.
  std::atomic<std::int32_t> thread;
  std::atomic<std::int64_t> deadline;  ///< Virtual time, ns; kNever: none.
  std::atomic<std::int64_t> interval;  ///< kTimer: ns; 0: it expires once.
  std::atomic<std::uint64_t> object;  ///< kParked: what it waits for; see programs/waits/parking.h.
  std::atomic<std::uint64_t> ticket;  ///< The earlier the wait, the lower; not 0.
  std::atomic<std::int32_t> descriptor;  ///< kTimer: of an eventfd to be written; -1: none.
  std::atomic<std::int32_t> signal;      ///< kTimer: to be sent; 0: none.
  std::atomic<std::uint32_t> readings;   ///< Of the clock since its last wait: see WaitPage.
  std::atomic<std::int32_t> timer;       ///< kTimer of timer_create(): its number; 0: another one.
  std::atomic<std::uint64_t> value;      ///< kTimer: what its signal carries.
  std::atomic<std::int32_t> target;      ///< kTimer: the thread that gets the signal; 0: any.
  std::atomic<std::uint32_t> overruns;   ///< kTimer: expirations since its last signal was sent,
                                         ///< which was still pending. Set by the run, too.
  std::array<std::uint32_t, 6> reserved;
};
static_assert(sizeof(WaitSlot) == 128);

/// Lock-step of one agent's programs: a page that the run shares with them. The library that is
/// preloaded (programs/waits) says of each thread whether it runs or waits, for what and until
/// when; the run (programs/lockstep) gives the virtual time, lets one thread of the agent run at a
/// time, and ends waits whose deadline has come.
///
/// Lives in shared memory, all zero at first. Any thread of any process.
struct WaitPage {
  static constexpr std::size_t kSlots = 512;

  std::atomic<std::int64_t> now;     ///< Virtual time, ns. Written by the run.
  std::atomic<std::uint64_t> seed;   ///< Of the programs' entropy. Written before any starts.
  std::atomic<std::uint32_t> event;  ///< A futex for the run: changes with each state of a slot.
  /// 1: the run has ended. Nobody waits for a turn any more, so that programs can end.
  std::atomic<std::uint32_t> is_over;
  std::atomic<std::uint32_t> is_awaited;  ///< 1: the run waits for `event`.
  std::atomic<std::uint32_t> used;        ///< Slots from this one on have never been taken.
  std::atomic<std::uint32_t> ports;       ///< Ephemeral ports given out.
  std::atomic<std::uint64_t> tickets;     ///< Waits so far.
  std::atomic<std::uint64_t> drawn;       ///< Processes that have drawn entropy.
  std::atomic<std::uint32_t> signals;     ///< Sent among the programs so far.
  std::atomic<std::uint64_t> spins;       ///< Times that a thread was made to sleep: see readings.
  /// System calls so far that may have woken a thread that waits in the kernel: see
  /// programs/waits/kernel_call.h.
  std::atomic<std::uint32_t> stirs;
  std::array<std::uint32_t, 47> reserved;
  /// Threads that are parked, by a hash of what for: what is 0 need not be searched for.
  std::array<std::atomic<std::uint32_t>, 256> parked;
  std::array<WaitSlot, kSlots> slots;
};

/// The place of the WaitPage in the file whose first page is the RoomPage.
inline constexpr std::size_t kWaitPageOffset = 4096;
inline constexpr std::size_t kRoomFileSize = kWaitPageOffset + sizeof(WaitPage);

}  // namespace programs::netns
