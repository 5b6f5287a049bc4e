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

/// The devices of one agent; null: it has none.
struct Devices {
  drivers::WheelDriver* wheels = nullptr;
  drivers::InfraredDriver* infrared = nullptr;
  PoseSource* pose = nullptr;
  std::vector<const drivers::SensorDriver*> sensors{};  ///< In the order of the file's `sensors`.
};

/// A device that feeds one channel or several of the session.
struct DevicePart {
  using Values = std::vector<std::vector<double>>;  ///< One for each of the channels.

  std::vector<Channel> channels;  ///< At least one, whose name is the device's.
  /// Errors: those of the device; kTimeout (what there is, is too old at `now`).
  std::function<tl::expected<Values, Error>(platform::BootTime now)> latest;
};

/// What an agent senses, in the order of its session. The arguments outlive the parts.
std::vector<DevicePart> parts_of(const RobotFile& file, const Devices& devices);

/// What a real agent can be asked for: the channels of its file, with the names, kinds and units
/// that a simulated one has (hal/types/channel.h), so that a controller meets no difference.
node::exchange::AgentOffer offer_of(const RobotFile& file, const Devices& devices);

/// Takes readings from the devices: the channels of offer_of().
class Sampler final : public node::agent::Sensors {
 public:
  /// @param file, devices  outlive the sampler.
  Sampler(const RobotFile& file, const Devices& devices);

  const node::exchange::AgentOffer& offer() const { return offer_; }

  /// Whose channels silent() is about.
  void set_wants(const Wants& wants) { wants_ = wants; }

  /// Asks each device once.
  void advance(Time at) override;
  bool sample(std::size_t channel, Time at, std::vector<double>& values) override;

  /// The devices, asked for or not, that give nothing young enough now: the wheels, then the parts.
  std::vector<SilentDevice> silent(platform::BootTime now) const;

  /// Where the agent is, world frame. Errors: kNotAvailable, kTimeout (the last fix is too old).
  /// @pre the agent has a source of poses.
  Result<Pose2> pose(platform::BootTime now) const;
  bool has_pose() const { return devices_.pose != nullptr; }

 private:
  const RobotFile& file_;
  const Devices& devices_;
  const std::vector<DevicePart> parts_;
  const node::exchange::AgentOffer offer_;
  Wants wants_;
  /// Of this control instant, by index into the offer's channels; none: the device is silent.
  std::vector<std::optional<std::vector<double>>> values_;
};

}  // namespace hal::robot::agent
