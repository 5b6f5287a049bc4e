#pragma once

#include <functional>
#include <memory>
#include <string>

#include "gateway/inspection/inspection_participant.h"

namespace gateway::inspection {

/// Reads the emergency stop of one agent: std_msgs/Bool (ROS 2 Humble) on
/// `rt/<agent>/emergency_stop`; true: stop, false: released. Reliable; a writer that keeps its last
/// sample (transient local) reaches a robot that starts later, too. A stop is released by the
/// writer that pulled it, or by any once that one is gone: what shows its own state cannot undo the
/// stop of another.
class EmergencyStopReader {
 public:
  /// @param on_change  called on a thread of DDS after each sample, with whether anybody stops;
  ///   may be empty.
  /// @throws std::runtime_error  if DDS makes no reader.
  EmergencyStopReader(InspectionParticipant& participant, const std::string& agent,
                      std::function<void(bool stop)> on_change = {});
  ~EmergencyStopReader();
  EmergencyStopReader(const EmergencyStopReader&) = delete;
  EmergencyStopReader& operator=(const EmergencyStopReader&) = delete;

  /// Whoever pulled it. Any thread.
  void release();

  bool is_stopped() const;  ///< The last sample; false before the first. Any thread.
  int writers() const;      ///< In sight now. Any thread.

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gateway::inspection
