#include "hal/robot/platform/device_thread.h"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <csignal>

namespace hal::robot::platform {
namespace {

/// A device that hangs up during a write causes an error of that write, not the end of the program.
/// For this thread only: the program may handle the signal differently elsewhere.
void block_broken_pipe_signals() {
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGPIPE);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

}  // namespace

DeviceThread::DeviceThread(Device& device, const Rules& rules) : device_(device), rules_(rules) {
  thread_ = std::thread([this] { run(); });
}

void DeviceThread::wake() {
  const std::scoped_lock lock(mutex_);
  woken_ = true;
  changed_.notify_all();
}

void DeviceThread::finish() {
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

bool DeviceThread::connected() const {
  const std::scoped_lock lock(mutex_);
  return connected_ && fresh();
}

std::string DeviceThread::trouble() const {
  const std::scoped_lock lock(mutex_);
  if (!connected_) return trouble_;
  return fresh() ? std::string{}
                 : fmt::format("silent for more than {} s", to_seconds(rules_.silence));
}

DeviceCounts DeviceThread::counts() const {
  const std::scoped_lock lock(mutex_);
  return counts_;
}

bool DeviceThread::fresh() const { return BootClock::now() - last_success_ <= rules_.silence; }

void DeviceThread::run() {
  block_broken_pipe_signals();
  Duration back_off = kFirstBackOff;
  bool go_on = true;
  while (go_on) {
    if (!connect()) {
      go_on = wait(back_off, false);
      back_off = std::min(2 * back_off, kLongestBackOff);
      continue;
    }
    back_off = kFirstBackOff;
    do {
      go_on = wait(rules_.period, true);
    } while (go_on && work());
    if (go_on) go_on = wait(back_off, false);
  }
  bool connected = false;
  {
    const std::scoped_lock lock(mutex_);
    connected = connected_;
    connected_ = false;
    trouble_ = "closed";
  }
  if (connected) device_.leave();
}

bool DeviceThread::connect() {
  if (const auto connected = device_.connect(); !connected) {
    note(connected.error());
    return false;
  }
  const std::scoped_lock lock(mutex_);
  connected_ = true;
  ++counts_.connections;
  last_success_ = BootClock::now();
  return true;
}

bool DeviceThread::work() {
  if (const auto worked = device_.work(); !worked) {
    note(worked.error());
    device_.on_lost();
    return false;
  }
  note_success();
  return true;
}

void DeviceThread::note(const Error& error) {
  const std::scoped_lock lock(mutex_);
  connected_ = false;
  trouble_ = error.message;
  ++counts_.failures;
  if (error.code == Errc::kProtocol) ++counts_.bad_answers;
}

void DeviceThread::note_success() {
  const std::scoped_lock lock(mutex_);
  const BootTime now = BootClock::now();
  if (rules_.late > Duration::zero() && now - last_success_ > rules_.late) ++counts_.late_refresh;
  last_success_ = now;
}

bool DeviceThread::wait(Duration at_most, bool may_be_woken) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, at_most, [&] { return ending_ || (may_be_woken && woken_); });
  if (may_be_woken) woken_ = false;
  return !ending_;
}

}  // namespace hal::robot::platform
