#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hal/robot/agent/sensor_watch.h"
#include "hal/robot/platform/event_loop.h"

namespace agentd {

/// Waits until every device of an agent has answered, and meanwhile says what it waits for, in the
/// log and to the service manager: after a second, then every five. In the loop.
class Readiness {
 public:
  using Silent = std::function<std::vector<hal::robot::agent::SilentDevice>()>;

  /// @param agent     its name, for the log.
  /// @param silent    what does not answer now.
  /// @param on_ready  called once, from the constructor if nothing is silent.  All and the loop
  ///   outlive this object.
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
