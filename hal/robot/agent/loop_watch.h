#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

#include "hal/robot/drivers/wheels.h"
#include "hal/robot/platform/event_loop.h"

namespace hal::robot::agent {

/// Stops the wheels when the loop hangs, in a system call or because of a bug: the driver's own
/// thread would otherwise keep repeating the last velocity.
class LoopWatch {
 public:
  /// @param limit  longest permitted silence of the loop, > 0.  Loop and wheels outlive the watch.
  LoopWatch(platform::EventLoop& loop, drivers::WheelDriver& wheels, Duration limit);
  ~LoopWatch();
  LoopWatch(const LoopWatch&) = delete;
  LoopWatch& operator=(const LoopWatch&) = delete;

  std::uint64_t hangs() const { return hangs_; }  ///< Times the wheels were stopped. Any thread.

 private:
  void beat();
  void watch();

  platform::EventLoop& loop_;
  drivers::WheelDriver& wheels_;
  Duration limit_;
  platform::EventLoop::Handle timer_ = 0;
  std::atomic<std::uint64_t> beats_ = 0;
  std::atomic<std::uint64_t> hangs_ = 0;
  std::mutex mutex_;  ///< Protects ending_.
  std::condition_variable end_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace hal::robot::agent
