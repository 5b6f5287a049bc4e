#pragma once

#include <set>
#include <string>
#include <vector>

#include "hal/robot/agent/robot_file.h"
#include "hal/types/time.h"

namespace hal::robot::agent {

/// A device of the agent that delivers no sufficiently recent value.
struct SilentDevice {
  std::string name;     ///< "wheels", or the channel that it feeds.
  std::string because;  ///< Reason, for messages.
  bool wanted = false;  ///< The controller requires its channel.
};

/// Logs once when a device is lost and once when it is back, and decides whether the wheels must
/// stop. A device that never delivered anything is not lost: the agent waits for it.
class SensorWatch {
 public:
  /// @param file  outlives the watch.
  explicit SensorWatch(const RobotFile& file) : file_(file) {}

  /// @param silent  all devices that are silent now.
  /// @return why the wheels must stop; empty: they may turn.
  std::string look(Time now, const std::vector<SilentDevice>& silent);

 private:
  bool stops_wheels(const SilentDevice& device) const;
  std::string consequence(const SilentDevice& device) const;

  const RobotFile& file_;
  std::set<std::string> never_heard_;
  std::set<std::string> lost_;
  bool looked_ = false;
};

}  // namespace hal::robot::agent
