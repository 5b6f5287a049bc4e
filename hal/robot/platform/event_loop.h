#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "hal/node/routing/ports.h"
#include "hal/robot/platform/boot_time.h"

namespace hal::robot::platform {

/// Blocks signals in this thread and in all threads that it starts later; they stay pending until
/// an EventLoop takes them.
/// @throws std::system_error
void block_signals(std::initializer_list<int> signals);

/// The event loop of an agent daemon: timers on a clock, descriptors, signals, and handlers posted
/// by other threads. Everything runs in run(), one handler at a time. A timer that expired while
/// the computer was suspended is late by at most the remaining sleep of the loop.
///
///   EventLoop loop;                                     // before any thread is started
///   loop.on_signals({SIGTERM}, [&](int) { loop.stop(); });
///   loop.watch(socket, [&] { … });
///   loop.run();
///
/// Time 0 is the construction of the loop.
class EventLoop final : public node::routing::Timers {
 public:
  using Handler = std::function<void()>;

  /// @param clock  outlives the loop.
  /// @throws std::system_error  if the process has too many open files.
  explicit EventLoop(Clock& clock = boot_clock());
  ~EventLoop() override;
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;

  Time now() const override;
  /// A time of the loop on the BootClock. @pre the loop uses the BootClock.
  BootTime on_boot_clock(Time at) const {
    return BootTime{start_.time_since_epoch() + at.time_since_epoch()};
  }
  /// A time in the past means now.
  Handle schedule(Time at, Handler handler) override;
  void cancel(Handle handle) override;

  using Watch = std::uint64_t;  ///< Never 0.
  /// Calls the handler whenever the descriptor is readable or has failed. Several watches may share
  /// one descriptor.
  Watch watch(int descriptor, Handler on_readable);
  void unwatch(Watch watch);  ///< No effect if there is no such watch.

  /// Handles these signals in the loop and blocks them as block_signals() does: call this function
  /// or block_signals() before any thread is started. Call once.
  /// @throws std::system_error
  void on_signals(std::initializer_list<int> signals, std::function<void(int signal)> handler);

  /// Runs the handler in the loop as soon as possible. Any thread.
  void post(Handler handler);

  /// Runs until stop() is called.
  void run();
  void stop() { stopped_ = true; }  ///< Call from a handler.

  /// Handles what is due, waiting for events at most that long. For tests and for the last
  /// exchange.
  void run_once(Duration at_most);

 private:
  using Due = std::pair<Time, Handle>;

  void wait(Duration at_most);
  void run_due_timers();
  void run_posted();
  void take_signals();

  Clock& clock_;
  Time start_;
  Handle last_ = 0;
  std::map<Due, Handler> timers_;
  std::map<Handle, Time> times_;
  struct Watched {
    int descriptor;
    Handler handler;
  };
  Watch last_watch_ = 0;
  std::map<Watch, Watched> watched_;
  std::function<void(int)> on_signal_;
  int signals_ = -1;
  int wake_up_ = -1;
  std::mutex mutex_;  ///< Protects posted_.
  std::vector<Handler> posted_;
  bool stopped_ = false;
};

}  // namespace hal::robot::platform
