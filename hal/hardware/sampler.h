#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/exchange/ports.h"
#include "hal/exchange/step.h"
#include "hal/hardware/robot_file.h"
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

  struct Sample {
    std::vector<exchange::Reading> readings;  ///< Of the channels that were asked for.
    /// Why there is no infrared reading, or none that is young enough, where one was asked for: the
    /// controller holds the last one, and would steer by it. Empty: there is.
    std::string blind_because;
  };
  /// @param now  on the clock of the devices.
  Sample take(SteadyTime now) const;

  /// Where the agent is, world frame; nothing without a fix that is young enough.
  std::optional<Pose2> pose(SteadyTime now) const;

 private:
  exchange::Reading localisation(SteadyTime now) const;
  void take_odometry(Sample& sample) const;
  void take_infrared(Sample& sample) const;

  const RobotFile& file_;
  const Devices& devices_;
  bool localisation_ = false, odometry_ = false, infrared_ = false, volts_ = false;
};

}  // namespace hal::hardware
