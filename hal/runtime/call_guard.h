#pragma once

#include <atomic>
#include <thread>

namespace hal::runtime {

/// Watches over the contract of RealWorldObject: its functions are called from within a callback of
/// that agent's controller, on the thread that runs the callback.
class CallGuard {
 public:
  /// While this lives, a callback runs on this thread.
  class Callback {
   public:
    explicit Callback(CallGuard& guard);
    ~Callback();
    Callback(const Callback&) = delete;
    Callback& operator=(const Callback&) = delete;

   private:
    CallGuard& guard_;
  };

  /// Throws std::logic_error, naming the call, when the contract is broken. Thread safe.
  void check(const char* call) const;

 private:
  /// Atomic, because the very calls that are to be caught come from other threads.
  std::atomic<std::thread::id> thread_{};
};

}  // namespace hal::runtime
