#include "programs/lockstep/timer_signal.h"

#include <fmt/format.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

namespace programs::lockstep {
namespace {

/// Whether it waits for the thread, or for any thread of the process, to take it.
bool is_pending(const KernelThread& target, bool of_thread, int signal) {
  constexpr int kHexadecimal = 16;
  std::ifstream status(fmt::format("/proc/{}/task/{}/status", target.process(), target.thread()));
  const std::string name = of_thread ? "SigPnd:" : "ShdPnd:";
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with(name)) continue;
    const auto set = std::strtoull(line.c_str() + name.size(), nullptr, kHexadecimal);
    return (set >> (signal - 1) & 1) != 0;
  }
  return false;
}

}  // namespace

std::uint64_t expire_once(netns::WaitSlot& timer, std::int64_t now) {
  const std::int64_t interval = timer.interval.load(), due = timer.deadline.load();
  if (interval <= 0) {
    timer.deadline = netns::kNever;
    return 1;
  }
  const std::int64_t times = (now - due) / interval + 1;
  timer.deadline = due + times * interval;
  return static_cast<std::uint64_t>(times);
}

bool send_signal(netns::WaitSlot& timer, const KernelThread& target, std::uint64_t times) {
  const bool of_thread = timer.target.load() != 0;
  const int signal = timer.signal.load();
  if (is_pending(target, of_thread, signal)) {
    timer.overruns += static_cast<std::uint32_t>(times);
    return true;
  }
  timer.overruns = static_cast<std::uint32_t>(times - 1);
  siginfo_t info{};
  info.si_signo = signal;
  info.si_code = SI_TIMER;
  info.si_timerid = timer.timer.load();
  info.si_overrun = static_cast<int>(times - 1);
  static_assert(sizeof info.si_value == sizeof(std::uint64_t));
  const std::uint64_t value = timer.value.load();
  std::memcpy(&info.si_value, &value, sizeof value);
  const long status =
      of_thread ? syscall(SYS_rt_tgsigqueueinfo, target.process(), target.thread(), signal, &info)
                : syscall(SYS_rt_sigqueueinfo, target.process(), signal, &info);
  return status == 0;
}

}  // namespace programs::lockstep
