#include "hal/node/routing/own_timers.h"

#include <algorithm>
#include <utility>

namespace hal::node::routing {

OwnTimers::~OwnTimers() {
  for (const Pending& pending : pending_) timers_.cancel(pending.handle);
}

OwnTimers::Handle OwnTimers::schedule(Time at, std::function<void()> handler) {
  const Handle own = ++last_;
  // The scheduled closure is small enough for std::function to store it without allocation.
  const Timers::Handle handle = timers_.schedule(at, [this, own] { take_out(own).run(); });
  pending_.push_back({own, handle, std::move(handler)});
  return own;
}

void OwnTimers::cancel(Handle handle) {
  const Pending pending = take_out(handle);
  if (pending.own != 0) timers_.cancel(pending.handle);
}

/// Empty if the timer has fired or was cancelled.
OwnTimers::Pending OwnTimers::take_out(Handle own) {
  const auto place = std::ranges::lower_bound(pending_, own, {}, &Pending::own);
  if (place == pending_.end() || place->own != own) return {};
  Pending pending = std::move(*place);
  pending_.erase(place);
  return pending;
}

}  // namespace hal::node::routing
