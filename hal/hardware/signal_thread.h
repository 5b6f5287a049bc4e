#pragma once

#include <functional>
#include <initializer_list>
#include <thread>

#include "hal/hardware/event_loop.h"

namespace hal::hardware {

/// Heeds signals on a thread of its own, for those that must not wait for what a loop is doing: the
/// loop may hang in a system call, and be it that nobody reads its log.
///
///   block_signals({SIGUSR1});                           // before any thread is started
///   …
///   SignalThread stops({SIGUSR1}, [&](int) { … });      // those that came meanwhile are heeded
///   now
class SignalThread {
 public:
  /// @param signals  blocked in all threads.  @param handler  is called on the other thread.
  /// @throws std::system_error
  SignalThread(std::initializer_list<int> signals, std::function<void(int signal)> handler);
  ~SignalThread();
  SignalThread(const SignalThread&) = delete;
  SignalThread& operator=(const SignalThread&) = delete;

 private:
  EventLoop loop_;
  std::thread thread_;
};

}  // namespace hal::hardware
