#include "sim/agents/movable_watch.h"

namespace sim::agents {

MovableWatch::MovableWatch(const physics::World& world, hal::Duration period)
    : world_(world), period_(period), has_moved_(world.movable_count(), true) {}

void MovableWatch::start(hal::Time now, Observer& observer) {
  due_ = now;
  on_step(now, observer);
}

void MovableWatch::on_step(hal::Time now, Observer& observer) {
  if (has_moved_.empty()) return;
  for (const std::uint32_t number : world_.moved_movables()) has_moved_[number] = true;
  if (now < due_) return;
  due_ = hal::Time{(now.time_since_epoch() / period_ + 1) * period_};
  for (std::uint32_t number = 0; number < has_moved_.size(); ++number) {
    if (!has_moved_[number]) continue;
    has_moved_[number] = false;
    observer.on_movable(now, number, world_.movable(number).pose);
  }
}

}  // namespace sim::agents
