#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "gateway/runtime/exit_watch.h"
#include "gateway/runtime/fault_watch.h"

namespace baraka::run {

/// Ends a run from outside its own thread when the thread cannot: when a callback of a controller
/// or a process does not return after the user has interrupted the run, and when a controller in
/// this process calls exit() or a similar function, or is ended by a signal or an exception. The
/// results so far are kept.
class ForcedEnd {
 public:
  /// Writes the results and how the run ended. Meanwhile the run's thread is blocked in a call.
  /// @param what  what happened, for display.
  /// @param failed  true: the run failed; false: it was interrupted.
  /// @return exit status.
  using Conclude = std::function<int(const std::string& what, bool failed)>;

  explicit ForcedEnd(Conclude conclude);
  ~ForcedEnd();
  ForcedEnd(const ForcedEnd&) = delete;
  ForcedEnd& operator=(const ForcedEnd&) = delete;

 private:
  void watch();
  void end_stuck_run();
  int status_of_end(const std::string& what, bool failed);

  Conclude conclude_;
  std::mutex mutex_;
  std::condition_variable over_changed_;
  bool over_ = false;
  std::optional<gateway::runtime::ExitWatch> exit_watch_;
  const gateway::runtime::FaultWatch fault_watch_{"error", true};
  std::thread watcher_;
};

}  // namespace baraka::run
