#pragma once

#include <atomic>
#include <thread>

namespace gateway::runtime {

/// Enforces the contract of RealWorldObject: its functions are called only from within a callback
/// of that agent's controller, on the thread that runs the callback.
class CallGuard {
 public:
  /// While this object exists, a callback runs on this thread.
  class Callback {
   public:
    explicit Callback(CallGuard& guard);
    ~Callback();
    Callback(const Callback&) = delete;
    Callback& operator=(const Callback&) = delete;

   private:
    CallGuard& guard_;
  };

  /// Throws std::logic_error with the name of the call if the contract is violated. Thread safe.
  void check(const char* call) const;

 private:
  /// Atomic, because the calls to be detected come from other threads.
  std::atomic<std::thread::id> thread_{};
};

}  // namespace gateway::runtime
