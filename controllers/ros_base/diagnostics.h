#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hal/api/robot.h"
#include "ros_nodes.h"

namespace controllers {

/// The statuses of a base: one for each channel that it reads, and one for its commands. Names are
/// "NODE: TASK" and the hardware's identity the agent's name, as of diagnostic_updater.
class Diagnostics {
 public:
  explicit Diagnostics(std::string node) : node_(std::move(node)) {}

  /// Once per control cycle: counts readings.
  void observe(const hal::Robot& robot);

  /// @param state  of the controller: "driving". @param commands  in total.
  std::vector<diagnostic_msgs::msg::dds_::DiagnosticStatus_> statuses(const hal::Robot& robot,
                                                                      const std::string& state,
                                                                      std::uint64_t commands);

 private:
  using Status = diagnostic_msgs::msg::dds_::DiagnosticStatus_;
  Status status(const hal::Robot& robot, const std::string& task) const;
  Status status_of_channel(const hal::Robot& robot, const std::string& channel) const;

  const std::string node_;
  std::map<std::string, std::uint64_t> readings_;  ///< Control cycles with a reading.
};

}  // namespace controllers
