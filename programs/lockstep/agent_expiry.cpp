// The waits and timers of an agent's programs whose time has come.
#include <sys/pidfd.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "programs/lockstep/agent_waits.h"
#include "programs/netns/descriptor.h"

namespace programs::lockstep {
namespace {

using netns::kEndWait;
using netns::SlotState;
using netns::WaitKind;
using netns::WaitSlot;

/// To an eventfd of another process, as if its timer had expired.
bool write_to(pid_t process, int descriptor) {
  const netns::FileDescriptor handle(static_cast<int>(syscall(SYS_pidfd_open, process, 0)));
  const netns::FileDescriptor file(
      static_cast<int>(syscall(SYS_pidfd_getfd, handle.get(), descriptor, 0)));
  constexpr std::uint64_t kOnce = 1;
  return file.is_open() && write(file.get(), &kOnce, sizeof kOnce) == sizeof kOnce;
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
  const std::int64_t interval = one.interval.load();
  one.deadline = interval > 0 ? one.deadline.load() + interval : netns::kNever;
  const pid_t process = tasks_.outside(one.process.load());
  const int signal = one.signal.load();
  if (signal != 0) see_all_asleep();
  const bool is_fired = process != 0 && (signal != 0 ? kill(process, signal) == 0
                                                     : write_to(process, one.descriptor.load()));
  if (signal != 0) see_all_asleep();
  if (!is_fired) release(i);
}

void AgentWaits::end_wait(std::size_t i) {
  WaitSlot& one = slot(i);
  // A frame that came in at this very instant may have ended it.
  if (one.kind.load() == WaitKind::kInKernel && !is_asleep(i)) return;
  ++counts_.expired;
  one.deadline = netns::kNever;
  one.expired = 1;
  if (one.kind.load() == WaitKind::kParked) {
    one.state = SlotState::kWants;
  } else {
    interrupt(i);
  }
}

void AgentWaits::interrupt(std::size_t i) {
  if (look(i) == KernelState::kGone) return;
  const KernelThread& kernel = threads_[i].kernel;
  syscall(SYS_tgkill, kernel.process(), kernel.thread(), kEndWait);
}

void AgentWaits::expire() {
  const std::int64_t now = page_.now.load();
  const auto is_due = [&](std::size_t i, SlotState state) {
    return slot(i).state.load() == state && slot(i).deadline.load() <= now;
  };
  for (std::size_t i = 0; i < used(); ++i) {
    if (is_due(i, SlotState::kWaiting)) end_wait(i);
  }
  for (std::size_t i = 0; i < used(); ++i) {
    if (!is_due(i, SlotState::kTimer)) continue;
    ++counts_.expired;
    fire(i);
  }
}

std::optional<std::int64_t> AgentWaits::deadline() const {
  std::int64_t earliest = netns::kNever;
  for (std::size_t i = 0; i < used(); ++i) {
    const WaitSlot& one = page_.slots[i];
    const SlotState state = one.state.load();
    if (state == SlotState::kWaiting || state == SlotState::kTimer)
      earliest = std::min(earliest, one.deadline.load());
  }
  if (earliest == netns::kNever) return std::nullopt;
  return earliest;
}

}  // namespace programs::lockstep
