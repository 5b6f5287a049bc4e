// The end of a run: the part of AgentWaits that tells programs to end, or lets them go.
#include <csignal>
#include <set>
#include <span>

#include "programs/lockstep/agent_waits.h"

namespace programs::lockstep {

using netns::SlotState;
using netns::WaitSlot;

std::set<pid_t> AgentWaits::processes() const {
  std::set<pid_t> all;
  for (const WaitSlot& one : std::span(page_.slots).first(used())) {
    const SlotState state = one.state.load();
    const bool is_thread = state != SlotState::kFree && state != SlotState::kTimer;
    if (is_thread && one.process.load() != 0) all.insert(one.process.load());
  }
  return all;
}

void AgentWaits::send(pid_t process, int signal) {
  const pid_t outside = tasks_.outside(process);
  if (outside == 0) return;
  see_all_asleep();
  kill(outside, signal);
  kill(outside, SIGCONT);
  see_all_asleep();
}

void AgentWaits::let_go() {
  page_.is_over = 1;
  for (std::size_t i = 0; i < used(); ++i) {
    WaitSlot& one = slot(i);
    if (one.state.load() == SlotState::kWants) grant(i);
    const bool is_timed = one.state.load() == SlotState::kWaiting && one.deadline != netns::kNever;
    if (is_timed && one.kind.load() == netns::WaitKind::kInKernel) end_wait(i);
  }
}

}  // namespace programs::lockstep
