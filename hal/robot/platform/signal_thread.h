#pragma once

#include <functional>
#include <initializer_list>
#include <thread>

#include "hal/robot/platform/event_loop.h"

namespace hal::robot::platform {

/// Heeds signals on a thread of its own: those that must not wait for a loop, which may hang in a
/// system call, for example because nobody reads its log.
///
///   block_signals({SIGUSR1});                       // before any thread is started
///   …
///   SignalThread stops({SIGUSR1}, [&](int) { … });  // also heeds those that came meanwhile
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

}  // namespace hal::robot::platform
