#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "hal/node/exchange/session.h"
#include "hal/types/geometry.h"
#include "hal/types/time.h"

namespace python::simulator {

/// What one agent shows at a control instant.
struct AgentView {
  std::map<std::string, std::vector<double>> readings;  ///< By channel; held until the next sample.
  hal::Pose2 pose;                                      ///< True, world frame.
  double clearance = 0;  ///< m from the body's origin to the nearest wall; infinite without walls.
};

/// A state of an episode.
struct Situation {
  hal::Time now{};
  std::vector<AgentView> agents;  ///< In the order of the names that were asked for.
  bool ended = false;
  std::string result;       ///< Of the end condition that was met, or "until"; if it has ended.
  std::string fingerprint;  ///< If it has ended.
};

/// One run of a scenario in which some robots are driven from outside, a control cycle at a time;
/// all others have their controllers, in this process. The run is on a thread of its own, which
/// stands still between two calls. Of begin() and advance() one at a time, from any thread; in a
/// process that was forked meanwhile there is no such thread, and they throw.
class Episode {
 public:
  /// @param file  a path or, as of `baraka run`, the name of a scenario that comes with BARAKA.
  /// @param overrides  as of --set.   @param agents  names of robots; at least one.
  /// @param until  end of the run; none: the scenario's end conditions alone.
  /// @throws std::exception  the scenario has mistakes, an agent is unknown or no robot, or a
  ///   controller is not there; lines as `baraka check` prints them.
  Episode(const std::string& file, const std::vector<std::string>& overrides,
          const std::vector<std::string>& agents, std::optional<hal::Time> until);
  ~Episode();
  Episode(const Episode&) = delete;
  Episode& operator=(const Episode&) = delete;

  /// The robots as their controllers would get to know them.
  const std::vector<hal::node::exchange::AgentSession>& sessions() const { return sessions_; }

  /// Goes on to the first control instant.
  Situation begin();
  /// Has each robot drive, and goes on to the next control instant. An action takes effect as those
  /// of controllers do, after the scenario's controller_latency.
  /// @param drives  one for each robot.   @throws std::runtime_error  the run failed, or has ended.
  Situation advance(const std::vector<hal::Twist2>& drives);
  /// Ends the run and waits until it has ended. From any thread: an advance() that waits throws.
  void end();

 private:
  class Run;
  enum class State : std::uint8_t { kNew, kRunning, kEnded };
  /// @throws std::runtime_error  another thread is in a call.
  std::unique_lock<std::mutex> take_turn();
  Situation next();

  const pid_t process_;
  std::mutex turn_;  ///< Of what follows.
  State state_ = State::kNew;
  std::vector<hal::node::exchange::AgentSession> sessions_;
  std::unique_ptr<Run> run_;
};

}  // namespace python::simulator
