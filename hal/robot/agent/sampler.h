#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "hal/node/agent/ports.h"
#include "hal/node/exchange/ports.h"
#include "hal/robot/agent/robot_file.h"
#include "hal/robot/agent/sensor_watch.h"
#include "hal/types/wants.h"

namespace hal::robot::agent {

/// The devices of one agent; null: it does not have this device.
struct Devices {
  drivers::WheelDriver* wheels = nullptr;
  drivers::InfraredDriver* infrared = nullptr;
  PoseSource* pose = nullptr;
  std::vector<const drivers::SensorDriver*> sensors{};  ///< In the order of the file's `sensors`.
};

/// A device that feeds one or more channels of the session.
struct DevicePart {
  using Values = std::vector<std::vector<double>>;  ///< One for each of the channels.

  std::vector<Channel> channels;  ///< At least one; the first has the name of the device.
  /// Errors: those of the device; kTimeout (the latest values are too old at `now`).
  std::function<tl::expected<Values, Error>(platform::BootTime now)> latest;
};

/// The sensors of an agent, in the order of its session. The arguments outlive the parts.
std::vector<DevicePart> parts_of(const RobotFile& file, const Devices& devices);

/// The channels that a real agent offers: those of its file, with the names, kinds and units of a
/// simulated agent (hal/types/channel.h), so that they do not differ for a controller.
node::exchange::AgentOffer offer_of(const RobotFile& file, const Devices& devices);

/// Reads the channels of offer_of() from the devices.
class Sampler final : public node::agent::Sensors {
 public:
  /// @param file, devices  outlive the sampler.
  Sampler(const RobotFile& file, const Devices& devices);

  const node::exchange::AgentOffer& offer() const { return offer_; }

  /// Sets the channels that silent() reports as wanted.
  void set_wants(const Wants& wants) { wants_ = wants; }

  /// Reads each device once.
  void advance(Time at) override;
  bool sample(std::size_t channel, Time at, std::vector<double>& values) override;

  /// The devices, wanted or not, without a sufficiently recent value: the wheels, then the parts.
  std::vector<SilentDevice> silent(platform::BootTime now) const;

  /// Pose of the agent in the world frame. Errors: kNotAvailable, kTimeout (the last fix is too
  /// old).
  /// @pre the agent has a source of poses.
  Result<Pose2> pose(platform::BootTime now) const;
  bool has_pose() const { return devices_.pose != nullptr; }

 private:
  const RobotFile& file_;
  const Devices& devices_;
  const std::vector<DevicePart> parts_;
  const node::exchange::AgentOffer offer_;
  Wants wants_;
  /// Values at this control instant by index into the offer's channels; nullopt: the device is
  /// silent.
  std::vector<std::optional<std::vector<double>>> values_;
};

}  // namespace hal::robot::agent
