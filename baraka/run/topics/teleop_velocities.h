#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gateway/inspection/twist_reader.h"
#include "sim/core/outside_input.h"

namespace baraka::run::topics {

/// The recorded form of a velocity: m/s, m/s, rad/s as binary64, little-endian.
std::vector<std::uint8_t> to_bytes(const hal::Twist2& twist);
/// @throws std::runtime_error  not 24 bytes, or a value that is not finite.
hal::Twist2 twist_of(std::span<const std::uint8_t> bytes);

/// Teleoperation velocities for one agent of a run. They enter the run as arrivals at the door
/// "cmd_vel of <agent>", so that they are recorded and a repetition has them at the same times.
class TeleopVelocities {
 public:
  using Command = gateway::inspection::TwistReader::Command;

  /// Opens the door. @param input  must outlive this object, and this object must outlive the run.
  TeleopVelocities(sim::OutsideInput& input, const std::string& agent);

  /// Passes on velocities received on `rt/<agent>/cmd_vel`. Not to be called in a repetition.
  /// @throws std::runtime_error  if DDS makes no reader.
  void listen(gateway::inspection::InspectionParticipant& participant);

  /// Passes on a velocity from another source. Any thread.
  void put(const hal::Twist2& twist) { input_.put(door_, to_bytes(twist)); }

  /// The velocity that the run has taken in last. On the run's thread.
  std::optional<Command> last() const { return last_; }

 private:
  sim::OutsideInput& input_;
  std::string agent_, door_;
  std::optional<Command> last_;
  std::unique_ptr<gateway::inspection::TwistReader> reader_;
};

}  // namespace baraka::run::topics
