#include "hal/robot/platform/event_loop.h"

#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <functional>
#include <system_error>

#include "hal/types/check.h"

namespace hal::robot::platform {
namespace {

constexpr Duration kLongestSleep = std::chrono::hours{1};  // longer sleeps are divided

int checked(int result, const char* what) {
  if (result < 0) throw std::system_error(errno, std::generic_category(), what);
  return result;
}

sigset_t set_of(std::initializer_list<int> signals) {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : signals) sigaddset(&set, signal);
  return set;
}

}  // namespace

void block_signals(std::initializer_list<int> signals) {
  const sigset_t set = set_of(signals);
  if (const int error = pthread_sigmask(SIG_BLOCK, &set, nullptr); error != 0) {
    throw std::system_error(error, std::generic_category(), "cannot block signals");
  }
}

EventLoop::EventLoop(Clock& clock)
    : clock_(clock),
      start_(clock.now()),
      wake_up_(checked(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK), "no event descriptor")) {
  watch(wake_up_, [this] { run_posted(); });
}

EventLoop::~EventLoop() {
  ::close(wake_up_);
  if (signals_ >= 0) ::close(signals_);
}

Time EventLoop::now() const { return Time{clock_.now() - start_}; }

EventLoop::Handle EventLoop::schedule(Time at, Handler handler) {
  at = std::max(at, now());
  const Handle handle = ++last_;
  times_.emplace(handle, at);
  timers_.emplace(Due{at, handle}, std::move(handler));
  return handle;
}

void EventLoop::cancel(Handle handle) {
  const auto found = times_.find(handle);
  if (found == times_.end()) return;
  timers_.erase({found->second, handle});
  times_.erase(found);
}

EventLoop::Watch EventLoop::watch(int descriptor, Handler on_readable) {
  watched_.emplace(++last_watch_, Watched{descriptor, std::move(on_readable)});
  return last_watch_;
}

void EventLoop::unwatch(Watch watch) { watched_.erase(watch); }

void EventLoop::on_signals(std::initializer_list<int> signals, std::function<void(int)> handler) {
  BARAKA_CHECK(signals_ < 0);
  block_signals(signals);
  const sigset_t set = set_of(signals);
  signals_ = checked(signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK), "no signal descriptor");
  on_signal_ = std::move(handler);
  watch(signals_, [this] { take_signals(); });
}

void EventLoop::take_signals() {
  signalfd_siginfo one{};
  std::vector<int> taken;
  while (::read(signals_, &one, sizeof one) == static_cast<ssize_t>(sizeof one)) {
    taken.push_back(static_cast<int>(one.ssi_signo));
  }
  // The kernel does not report the order in which they were sent. SIGUSR2 is handled before
  // SIGUSR1.
  std::ranges::sort(taken, std::greater{});
  for (const int signal : taken) on_signal_(signal);
}

void EventLoop::post(Handler handler) {
  {
    const std::lock_guard lock(mutex_);
    posted_.push_back(std::move(handler));
  }
  // It can only fail when the counter is full, and then the loop wakes up anyway.
  [[maybe_unused]] const int result = eventfd_write(wake_up_, 1);
}

void EventLoop::run_posted() {
  eventfd_t count = 0;
  [[maybe_unused]] const int result = eventfd_read(wake_up_, &count);
  std::vector<Handler> posted;
  {
    const std::lock_guard lock(mutex_);
    posted.swap(posted_);
  }
  for (const Handler& handler : posted) handler();
}

void EventLoop::run() {
  stopped_ = false;
  while (!stopped_) run_once(kLongestSleep);
}

void EventLoop::run_once(Duration at_most) {
  Duration left = at_most;
  if (!timers_.empty()) left = std::min(left, timers_.begin()->first.first - now());
  wait(std::max(left, Duration::zero()));
  run_due_timers();
}

void EventLoop::wait(Duration at_most) {
  std::vector<pollfd> polled;
  std::vector<Watch> watches;
  for (const auto& [watch, watched] : watched_) {
    polled.push_back({watched.descriptor, POLLIN, 0});
    watches.push_back(watch);
  }
  if (clock_.wait(polled, at_most) <= 0) return;  // EINTR: poll again
  for (std::size_t i = 0; i < polled.size(); ++i) {
    if (polled[i].revents == 0) continue;
    // An earlier handler may have removed this watch. Copied, because the handler may remove
    // itself.
    const auto found = watched_.find(watches[i]);
    if (found == watched_.end()) continue;
    const Handler handler = found->second.handler;
    handler();
  }
}

/// Runs the timers due now, but not those scheduled by them, so that descriptors get their turn.
void EventLoop::run_due_timers() {
  const Due until{now(), last_};
  while (!timers_.empty() && timers_.begin()->first <= until) {
    auto due = timers_.extract(timers_.begin());
    times_.erase(due.key().second);
    due.mapped()();
  }
}

}  // namespace hal::robot::platform
