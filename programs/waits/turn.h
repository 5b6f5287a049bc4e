#pragma once

#include <cstdint>

#include "programs/preload/dilation.h"
#include "programs/waits/slots.h"

namespace programs::waits {

using preload::kSecond;
using preload::Nanoseconds;

/// Virtual time of the run, ns. @pre page() is not null.
Nanoseconds now();

/// Whether the run has ended: waits then end soon, whatever their deadline is.
bool is_over();

/// After a system call that is not known to wait: if it has, and the run went on meanwhile, waits
/// for this thread's turn.
void return_from_call();

/// This thread has to go on: waits for its turn. @param slot  its own.
void want_to_go_on(WaitSlot& slot);

/// Tells the run that a slot has changed.
void tell_run();

/// Lets a thread that another one has just woken go on if the run is over: nobody gives it its
/// turn.
void go_on_after_end(WaitSlot& slot);

/// Tells the run, before a system call, that it may wake threads of this agent that wait in the
/// kernel. All calls say so but those that are known not to.
void stir();
/// The same before a call that reads: it wakes those only that wait until they can send or write.
void stir_by_reading();

/// How a wait ended.
enum class Woken : std::uint8_t {
  kByThread,    ///< wake(), or the run.
  kByDeadline,  ///< The virtual time of its deadline has come.
  kBySignal,    ///< A handler of the program has run.
};

/// Waits, without a system call that another thread could end, until wake() names the object, or
/// the deadline. Returns when it is this thread's turn. Since one thread of an agent runs at a
/// time, nothing happens between a look at the object and this call. @param object  not 0.
Woken park(std::uint64_t object, Nanoseconds deadline);

/// Makes threads that are parked for this object want to go on: those that have waited longest.
/// @return how many.
unsigned wake(std::uint64_t object, unsigned most);

/// The thread that wake() would let go on first, by its number; 0: none.
std::int32_t first_waiting(std::uint64_t object);

/// Around a system call that waits: publishes what this thread is about to do.
///
///   KernelWait wait(deadline);
///   const long result = call();
///   wait.end();                 // returns when it is this thread's turn; errno stays
///   if (wait.has_expired()) …
///
/// Meanwhile the thread is not cancelled; a cancellation_point() after it does that.
class KernelWait {
 public:
  /// @param object  0, or netns::kSendingObject.
  explicit KernelWait(Nanoseconds deadline, std::uint64_t object = 0);
  ~KernelWait() { end(); }
  KernelWait(const KernelWait&) = delete;
  KernelWait& operator=(const KernelWait&) = delete;

  void end();
  bool has_expired() const { return expired_; }

 private:
  WaitSlot& slot_;
  int cancel_state_ = 0;
  bool is_over_ = false, expired_ = false;
};

/// Sleeps until a virtual time. @return false: a handler of the program has run before.
bool sleep_until(Nanoseconds until);

/// Lets those go on that want to; returns when it is this thread's turn again. In a handler that
/// runs while its thread waits: at once.
void give_turn_away();

/// Counts looks at the clock, or without waiting at descriptors: a thread that does nothing else
/// would keep virtual time from passing, so after many of them it sleeps for a short while.
void count_look(unsigned weight);

}  // namespace programs::waits
