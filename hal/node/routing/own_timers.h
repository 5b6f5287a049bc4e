#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "hal/node/routing/ports.h"

namespace hal::node::routing {

/// Timers of one part of a router: its destruction cancels those that are pending.
class OwnTimers {
 public:
  explicit OwnTimers(Timers& timers) : timers_(timers) {}
  ~OwnTimers();
  OwnTimers(const OwnTimers&) = delete;
  OwnTimers& operator=(const OwnTimers&) = delete;

  using Handle = std::uint64_t;  ///< Never 0.
  Time now() const { return timers_.now(); }
  Handle schedule(Time at, std::function<void()> handler);
  void cancel(Handle handle);

 private:
  struct Pending {
    Handle own = 0;
    Timers::Handle handle = 0;
    std::function<void()> run;
  };

  Pending take_out(Handle own);

  Timers& timers_;
  Handle last_ = 0;
  std::vector<Pending> pending_;  ///< By own handle. Few.
};

}  // namespace hal::node::routing
