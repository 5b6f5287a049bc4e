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

/// Takes signals off their usual ways, in this thread and in all that it starts from now on: until
/// an EventLoop takes them they wait. @throws std::system_error
void block_signals(std::initializer_list<int> signals);

/// The one thread of an agent daemon: timers on a clock, descriptors, signals, and what other
/// threads hand over. Everything runs in run(), one handler at a time. A timer that came due while
/// the computer was suspended comes late, by no more than the loop would still have slept.
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
  /// When the loop goes by the BootClock: a time of the loop as that clock tells it.
  BootTime on_boot_clock(Time at) const {
    return BootTime{start_.time_since_epoch() + at.time_since_epoch()};
  }
  /// A time in the past is now.
  Handle schedule(Time at, Handler handler) override;
  void cancel(Handle handle) override;

  using Watch = std::uint64_t;  ///< Never 0.
  /// Calls the handler while the descriptor is readable, or has failed. Several may watch one.
  Watch watch(int descriptor, Handler on_readable);
  void unwatch(Watch watch);  ///< One that is not there: no effect.

  /// Takes these signals into the loop, which blocks them as block_signals() does: call this or
  /// that before any thread is started. Once.
  /// @throws std::system_error
  void on_signals(std::initializer_list<int> signals, std::function<void(int signal)> handler);

  /// Runs the handler in the loop, soon. Any thread.
  void post(Handler handler);

  /// Works until stop() is called.
  void run();
  void stop() { stopped_ = true; }  ///< From a handler.

  /// Works off what is due, waiting for something at most so long. For tests and for a last word.
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
  std::mutex mutex_;  ///< Of posted_.
  std::vector<Handler> posted_;
  bool stopped_ = false;
};

}  // namespace hal::robot::platform
