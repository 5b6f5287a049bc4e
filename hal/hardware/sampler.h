#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/exchange/ports.h"
#include "hal/exchange/step.h"
#include "hal/hardware/robot_file.h"
#include "hal/hardware/sensor_watch.h"
#include "hal/types/wants.h"

namespace hal::hardware {

/// The devices of one agent; null: it has none.
struct Devices {
  WheelDriver* wheels = nullptr;
  InfraredDriver* infrared = nullptr;
  PoseSource* pose = nullptr;
};

/// What a real agent can be asked for: the channels of its file, with the names, kinds and units
/// that a simulated one has (hal/types/channel.h), so that a controller meets no difference.
exchange::AgentOffer offer_of(const RobotFile& file, const Devices& devices);

/// Takes readings from the devices.
class Sampler {
 public:
  /// @param file, devices  outlive the sampler.
  Sampler(const RobotFile& file, const Devices& devices) : file_(file), devices_(devices) {}

  void set_wants(const Wants& wants);

  /// Of the channels that were asked for; those that are silent are marked as lost.
  std::vector<exchange::Reading> take(BootTime now) const;

  /// The devices, asked for or not, that give nothing young enough now.
  std::vector<SilentDevice> silent(BootTime now) const;

  /// Where the agent is, world frame. Errors: kNotAvailable, kTimeout (the last fix is too old).
  /// @pre the agent has a source of poses.
  Result<Pose2> pose(BootTime now) const;
  bool has_pose() const { return devices_.pose != nullptr; }

 private:
  exchange::Reading localisation(BootTime now) const;
  exchange::Reading odometry() const;
  void take_infrared(std::vector<exchange::Reading>& readings) const;

  const RobotFile& file_;
  const Devices& devices_;
  Wants wants_;
  bool localisation_ = false, odometry_ = false, infrared_ = false, volts_ = false;
};

}  // namespace hal::hardware
