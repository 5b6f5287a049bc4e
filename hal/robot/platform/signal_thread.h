#pragma once

#include <functional>
#include <initializer_list>
#include <thread>

#include "hal/robot/platform/event_loop.h"

namespace hal::robot::platform {

/// Handles signals on its own thread: those that must not wait for a loop, which may hang in a
/// system call, for example because its log is not being read.
///
///   block_signals({SIGUSR1});                       // before any thread is started
///   …
///   SignalThread stops({SIGUSR1}, [&](int) { … });  // also handles earlier signals
class SignalThread {
 public:
  /// @param signals  blocked in all threads.  @param handler  called on the new thread.
  /// @throws std::system_error
  SignalThread(std::initializer_list<int> signals, std::function<void(int signal)> handler);
  ~SignalThread();
  SignalThread(const SignalThread&) = delete;
  SignalThread& operator=(const SignalThread&) = delete;

 private:
  EventLoop loop_;
  std::thread thread_;
};

}  // namespace hal::robot::platform
