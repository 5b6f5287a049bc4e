#pragma once

#include <functional>
#include <memory>
#include <string>

#include "gateway/inspection/inspection_participant.h"

namespace gateway::inspection {

/// Reads the emergency stop of one agent: std_msgs/Bool (ROS 2 Humble) on
/// `rt/<agent>/emergency_stop`; true: stop, false: release. Reliable; a writer that keeps its last
/// sample (transient local) also reaches a robot that starts later. Only the writer that ordered a
/// stop can release it or, once that writer is gone, any other. So a writer that merely publishes
/// its own state cannot undo the stop of another.
class EmergencyStopReader {
 public:
  /// @param on_change  called on a thread of DDS after each sample, with whether a stop of any
  ///   writer is in force; may be empty.
  /// @throws std::runtime_error  if DDS makes no reader.
  EmergencyStopReader(InspectionParticipant& participant, const std::string& agent,
                      std::function<void(bool stop)> on_change = {});
  ~EmergencyStopReader();
  EmergencyStopReader(const EmergencyStopReader&) = delete;
  EmergencyStopReader& operator=(const EmergencyStopReader&) = delete;

  /// Releases all stops, whoever ordered them. Any thread.
  void release();

  bool is_stopped() const;  ///< Whether a stop of any writer is in force. Any thread.
  int writers() const;      ///< Writers matched now. Any thread.

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gateway::inspection
