#include "programs/lockstep/agent_waits.h"

#include <fmt/format.h>
#include <linux/futex.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

#include "programs/lockstep/wall_time.h"

namespace programs::lockstep {
namespace {

using netns::SlotState;
using netns::WaitPage;
using netns::WaitSlot;

void futex_wake(std::atomic<std::uint32_t>& word) {
  syscall(SYS_futex, &word, FUTEX_WAKE, 1, nullptr, nullptr, 0);
}

}  // namespace

AgentWaits::AgentWaits(WaitPage& page, Settings settings)
    : page_(page),
      settings_(std::move(settings)),
      tasks_(std::move(settings_.processes)),
      charge_(settings_.per_wake) {}

void AgentWaits::set_time(std::int64_t now) { page_.now.store(now); }

std::size_t AgentWaits::reserve() {
  const auto free = std::ranges::find_if(
      page_.slots, [](const WaitSlot& one) { return one.state.load() == SlotState::kFree; });
  if (free == page_.slots.end()) {
    throw std::runtime_error(
        fmt::format("{} has more than {} threads and timers, the most in "
                    "lock-step",
                    settings_.agent, WaitPage::kSlots));
  }
  const auto i = static_cast<std::size_t>(free - page_.slots.begin());
  free->deadline = netns::kNever;
  free->process = free->thread = 0;
  free->grant = free->expired = free->readings = 0;
  free->state = SlotState::kExpected;
  page_.used = std::max(page_.used.load(), static_cast<std::uint32_t>(i + 1));
  threads_[i] = {};
  threads_[i].is_program = true;
  return i;
}

void AgentWaits::started(std::size_t i, pid_t process) {
  std::int32_t unknown = 0;
  slot(i).process.compare_exchange_strong(unknown, process);
}

void AgentWaits::not_started(std::size_t i) {
  threads_[i] = {};
  slot(i).state = SlotState::kFree;
}

void AgentWaits::wait_for_event(std::uint32_t seen, std::int64_t longest) {
  const timespec time{0, longest};
  page_.is_awaited.store(1);
  if (page_.event.load() == seen)
    syscall(SYS_futex, &page_.event, FUTEX_WAIT, seen, &time, nullptr, 0);
  page_.is_awaited.store(0);
}

/// The parent of a process is told of its end after /proc shows it, under a lock that getpriority()
/// takes, too (exit_notify() of kernel/exit.c).
void AgentWaits::release(std::size_t i) {
  getpriority(PRIO_PGRP, 0);
  looks_at_parked_ = true;  // SIGCHLD
  WaitSlot& one = slot(i);
  if (one.thread.load() == one.process.load()) tasks_.forget(one.process.load());
  if (threads_[i].is_program) ended_.push_back(i);
  threads_[i] = {};
  const pid_t process = one.process.exchange(0);
  one.thread = 0;
  one.state = SlotState::kFree;
  if (process != 0) release_timers(process);
  wake(netns::kFileLockObject);
}

void AgentWaits::grant(std::size_t i) {
  ++counts_.turns;
  threads_[i].asleep_since = 0;
  threads_[i].is_in_unknown_call = false;
  running_since_ = wall_time();
  has_warned_ = false;
  slot(i).state.store(SlotState::kRunning);
  slot(i).grant.store(1);
  futex_wake(slot(i).grant);
}

/// Once it is, it stays so: whoever waits inside a wait is told, too.
bool AgentWaits::is_broken_off() {
  const std::int64_t now = wall_time();
  if (is_broken_off_ || now - asked_at_ < 50 * kMillisecond) return is_broken_off_;
  asked_at_ = now;
  is_broken_off_ = !settings_.may_go_on();
  return is_broken_off_;
}

bool AgentWaits::is_broken_off_meanwhile() {
  warn_of_long_run();
  return is_broken_off();
}

/// Whether something has to be waited for before the next thread may go on.
bool AgentWaits::is_unsettled(std::uint32_t seen) {
  if (is_one_running(seen)) return true;
  if (!release_ended()) return !are_all_asleep();
  wait_for_event(seen, 30 * kMicrosecond);
  return true;
}

std::optional<std::size_t> AgentWaits::next_turn(Turns turns) {
  const auto wants = [this](std::size_t i) { return slot(i).state.load() == SlotState::kWants; };
  std::size_t first = charge_.slot().value_or(0);
  if (!wants(first)) {
    charge_.drop();
    for (first = 0; first < used() && !wants(first);) ++first;
  }
  if (first == used()) return std::nullopt;
  if (turns == Turns::kFree) {
    charge_.drop();
  } else if (!charge_.is_paid(first, page_.now.load())) {
    return std::nullopt;
  }
  return first;
}

bool AgentWaits::settle(Turns turns) {
  running_since_ = wall_time();
  is_stirred_ = true;
  while (!is_broken_off()) {
    const std::uint32_t seen = page_.event.load();
    if (is_unsettled(seen)) continue;
    if (const auto next = next_turn(turns)) {
      grant(*next);
    } else if (page_.event.load() == seen && !looks_at_parked_) {
      return true;
    }
  }
  return false;
}

bool AgentWaits::is_one_waiting(std::uint64_t object) const {
  return std::any_of(page_.slots.begin(), page_.slots.begin() + static_cast<std::ptrdiff_t>(used()),
                     [object](const WaitSlot& one) {
                       return one.object.load() == object &&
                              one.state.load() == SlotState::kWaiting;
                     });
}

bool AgentWaits::wake_for_room() { return wake(netns::kRoomObject); }

bool AgentWaits::wake(std::uint64_t object) {
  bool is_one = false;
  for (std::size_t i = 0; i < used(); ++i) {
    WaitSlot& one = slot(i);
    if (one.object.load() != object || one.state.load() != SlotState::kWaiting) continue;
    one.state = SlotState::kWants;
    is_one = true;
  }
  return is_one;
}

std::vector<std::size_t> AgentWaits::take_ended() { return std::exchange(ended_, {}); }

}  // namespace programs::lockstep
