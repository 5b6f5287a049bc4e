#pragma once

#include <set>
#include <string>
#include <vector>

#include "hal/robot/agent/robot_file.h"
#include "hal/types/time.h"

namespace hal::robot::agent {

/// A device of the agent that gives nothing young enough to be used.
struct SilentDevice {
  std::string name;     ///< "wheels", or the channel it feeds.
  std::string because;  ///< For people.
  bool wanted = false;  ///< The controller cannot do without its channel.
};

/// Tells in the log, once, that a device was lost, and once that it is back; and judges what that
/// means for the wheels. A device that was never heard is not lost: the agent waits for it.
class SensorWatch {
 public:
  /// @param file  outlives the watch.
  explicit SensorWatch(const RobotFile& file) : file_(file) {}

  /// @param silent  all that are now.
  /// @return why the wheels must stand; empty: they may turn.
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
