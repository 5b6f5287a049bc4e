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

/// Ends a run from outside its own thread, when that will not: a controller's callback or a process
/// that does not return while the user wants to go, and a controller in this process that calls
/// exit() or its like, or that a signal or an exception of its own ends. What there are of results
/// is kept.
class ForcedEnd {
 public:
  /// Writes results and says how it ended. The run's thread is in a call that was seized.
  /// @param what  happened, for people.  @param failed  else it is interrupted.
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
