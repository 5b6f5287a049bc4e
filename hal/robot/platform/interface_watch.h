#pragma once

#include <functional>

#include "hal/robot/platform/event_loop.h"

namespace hal::robot::platform {

/// Tells when a network interface comes, goes or changes, or an IPv4 address does (rtnetlink(7)).
class InterfaceWatch {
 public:
  /// @param on_change  called in the loop, once for what changed together. The loop outlives this.
  /// @throws std::system_error
  InterfaceWatch(EventLoop& loop, std::function<void()> on_change);
  ~InterfaceWatch();
  InterfaceWatch(const InterfaceWatch&) = delete;
  InterfaceWatch& operator=(const InterfaceWatch&) = delete;

 private:
  void drain() const;

  EventLoop& loop_;
  int socket_;
  EventLoop::Watch watch_;
};

}  // namespace hal::robot::platform
