// Deadlines that have come: the part of AgentWaits that ends waits and lets timers expire.
#include <sys/pidfd.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <span>
#include <vector>

#include "programs/lockstep/agent_waits.h"
#include "programs/lockstep/timer_signal.h"
#include "programs/netns/descriptor.h"

namespace programs::lockstep {
namespace {

using netns::SlotState;
using netns::WaitKind;
using netns::WaitSlot;

/// To an eventfd of another process, as if its timer had expired so often.
bool write_to(pid_t process, int descriptor, std::uint64_t times) {
  const netns::FileDescriptor handle(static_cast<int>(syscall(SYS_pidfd_open, process, 0)));
  const netns::FileDescriptor file(
      static_cast<int>(syscall(SYS_pidfd_getfd, handle.get(), descriptor, 0)));
  return file.is_open() && write(file.get(), &times, sizeof times) == sizeof times;
}

}  // namespace

void AgentWaits::see_all_asleep() {
  do {
    looks_at_parked_ = true;
  } while (!are_all_asleep() && !is_broken_off());
}

/// A handler is over before the next timer expires, and begins after all have seen that their waits
/// have ended.
void AgentWaits::fire(std::size_t i) {
  WaitSlot& one = slot(i);
  const std::uint64_t times = expire_once(one, page_.now.load());
  const pid_t process = one.process.load();
  const pid_t outside = tasks_.outside(process);
  const int signal = one.signal.load();
  if (signal != 0) see_all_asleep();
  bool is_fired = outside != 0;
  if (is_fired && one.timer.load() != 0) {
    const pid_t target = one.target.load() != 0 ? one.target.load() : process;
    is_fired = send_signal(one, tasks_.find(process, target), times);
  } else if (is_fired) {
    is_fired =
        signal != 0 ? kill(outside, signal) == 0 : write_to(outside, one.descriptor.load(), times);
  }
  if (signal != 0) see_all_asleep();
  if (!is_fired) release(i);
}

void AgentWaits::end_wait(std::size_t i) {
  if (look(i) == KernelState::kGone) return;
  const KernelThread& kernel = threads_[i].kernel;
  syscall(SYS_tgkill, kernel.process(), kernel.thread(), netns::kEndWait);
}

/// All waits end before a timer expires.
bool AgentWaits::expire() {
  const std::int64_t now = page_.now.load();
  const auto is_due = [&](std::size_t i, SlotState state) {
    return slot(i).state.load() == state && slot(i).deadline.load() <= now;
  };
  for (std::size_t i = 0; i < used(); ++i) {
    if (is_due(i, SlotState::kWaiting)) expire_wait(i);
  }
  std::vector<pid_t> signalled;
  bool is_one_left = false;
  for (std::size_t i = 0; i < used(); ++i) {
    if (!is_due(i, SlotState::kTimer)) continue;
    if (slot(i).signal.load() != 0) {
      const pid_t process = slot(i).process.load();
      if (std::ranges::find(signalled, process) != signalled.end()) {
        is_one_left = true;
        continue;
      }
      signalled.push_back(process);
    }
    ++counts_.expired;
    fire(i);
  }
  return is_one_left;
}

void AgentWaits::expire_wait(std::size_t i) {
  WaitSlot& one = slot(i);
  // A frame that came in at this very instant may have ended it.
  if (one.kind.load() == WaitKind::kInKernel && !is_asleep(i)) return;
  ++counts_.expired;
  one.deadline = netns::kNever;
  one.expired = 1;
  if (one.kind.load() == WaitKind::kParked) {
    one.state = SlotState::kWants;
  } else {
    end_wait(i);
  }
}

std::optional<std::int64_t> AgentWaits::deadline() const {
  std::int64_t earliest = charge_.due().value_or(netns::kNever);
  for (std::size_t i = 0; i < used(); ++i) {
    const WaitSlot& one = page_.slots[i];
    const SlotState state = one.state.load();
    if (state == SlotState::kWaiting || state == SlotState::kTimer)
      earliest = std::min(earliest, one.deadline.load());
  }
  if (earliest == netns::kNever) return std::nullopt;
  return earliest;
}

/// Those of a process that has no thread any more.
void AgentWaits::release_timers(pid_t process) {
  const auto slots = std::span(page_.slots).first(used());
  const auto is_its = [process](const WaitSlot& one) { return one.process.load() == process; };
  const auto is_timer = [](const WaitSlot& one) { return one.state.load() == SlotState::kTimer; };
  const bool has_threads = std::ranges::any_of(slots, [&](const WaitSlot& one) {
    return is_its(one) && !is_timer(one) && one.state.load() != SlotState::kFree;
  });
  if (has_threads) return;
  for (WaitSlot& one : slots) {
    if (!is_its(one) || !is_timer(one)) continue;
    netns::hand_over(one, slots);
    one.process = 0;
    one.state = SlotState::kFree;
  }
}

}  // namespace programs::lockstep
