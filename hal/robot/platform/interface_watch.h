#pragma once

#include <functional>

#include "hal/robot/platform/event_loop.h"

namespace hal::robot::platform {

/// Reports when a network interface or an IPv4 address is added, removed or changed (rtnetlink(7)).
class InterfaceWatch {
 public:
  /// @param on_change  called in the loop, once for simultaneous changes. The loop outlives this.
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
