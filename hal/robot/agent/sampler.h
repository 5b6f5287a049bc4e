#pragma once

#include <cstdint>
#include <map>
#include <string>
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

  /// The devices, asked for or not, that give nothing young enough now.
  std::vector<SilentDevice> silent(platform::BootTime now) const;

  /// Where the agent is, world frame. Errors: kNotAvailable, kTimeout (the last fix is too old).
  /// @pre the agent has a source of poses.
  Result<Pose2> pose(platform::BootTime now) const;
  bool has_pose() const { return devices_.pose != nullptr; }

 private:
  std::uint16_t id_of(std::size_t sensor) const;  ///< Of a channel. @param sensor  of the file

  const RobotFile& file_;
  const Devices& devices_;
  const node::exchange::AgentOffer offer_;
  Wants wants_;
  std::map<std::uint16_t, std::vector<double>> values_;  ///< By channel, of this control instant.
};

}  // namespace hal::robot::agent
