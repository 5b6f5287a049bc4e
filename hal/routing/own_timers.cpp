#include "hal/routing/own_timers.h"

#include <utility>

namespace hal::routing {

OwnTimers::~OwnTimers() {
  for (const auto& [own, handle] : pending_) timers_.cancel(handle);
}

OwnTimers::Handle OwnTimers::schedule(Time at, std::function<void()> handler) {
  const Handle own = ++last_;
  pending_[own] = timers_.schedule(at, [this, own, run = std::move(handler)] {
    pending_.erase(own);
    run();
  });
  return own;
}

void OwnTimers::cancel(Handle handle) {
  const auto pending = pending_.extract(handle);
  if (!pending.empty()) timers_.cancel(pending.mapped());
}

}  // namespace hal::routing
