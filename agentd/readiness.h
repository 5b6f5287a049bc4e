#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hal/robot/agent/sensor_watch.h"
#include "hal/robot/platform/event_loop.h"

namespace agentd {

/// Waits until every device of an agent has answered. Meanwhile it reports what it waits for, to
/// the log and to the service manager: after one second, then every five. Runs in the loop.
class Readiness {
 public:
  using Silent = std::function<std::vector<hal::robot::agent::SilentDevice>()>;

  /// @param agent  its name, for the log.
  /// @param silent  returns the devices that do not answer now.
  /// @param on_ready  called once; from the constructor if no device is silent. All arguments and
  /// the loop outlive this object.
  Readiness(hal::robot::platform::EventLoop& loop, std::string agent, Silent silent,
            std::function<void()> on_ready);
  ~Readiness() { loop_.cancel(timer_); }
  Readiness(const Readiness&) = delete;
  Readiness& operator=(const Readiness&) = delete;

 private:
  void look();
  void say(const std::vector<hal::robot::agent::SilentDevice>& silent) const;

  hal::robot::platform::EventLoop& loop_;
  std::string agent_;
  Silent silent_;
  std::function<void()> on_ready_;
  hal::Time say_at_;
  hal::robot::platform::EventLoop::Handle timer_ = 0;
};

}  // namespace agentd
