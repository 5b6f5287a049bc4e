#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "hal/robot/drivers/robotino.h"
#include "hal/robot/drivers/velocity_command.h"
#include "hal/types/result.h"

namespace hal::robot::drivers {

/// One HTTP connection to the REST interface of a Festo Robotino 3 or 4 (Festo Didactic, "Rest
/// API", wiki.openrobotino.org/Rest_api.html). Base `/data/`, parameter `sid` names the client:
///
///   PUT omnidrive             [vx, vy, omega]                        m/s, rad/s; body frame
///   GET odometry              [x, y, rot, vx, vy, omega, sequence]   m, rad, m/s, rad/s
///   GET distancesensorarray   nine numbers, sensor i at i * 40 deg
///
/// Every call waits for the answer, no longer than the settings' time-out for connecting and as
/// long again for the whole exchange. Errors: kNotConnected; kTimeout (also an answer of more than
/// 16 kB, which would not end in time); kProtocol (a status other than 200 … 299, or a body that is
/// not what it should be). One thread.
class RobotinoRest {
 public:
  static constexpr std::size_t kSensors = 9;

  struct Odometry {
    Pose2 pose;  ///< Since the robot was switched on.
    Twist2 twist;
    double sequence = 0;  ///< Advances with every new measurement.
  };

  explicit RobotinoRest(const RobotinoSettings& settings);
  ~RobotinoRest();
  RobotinoRest(const RobotinoRest&) = delete;
  RobotinoRest& operator=(const RobotinoRest&) = delete;

  /// Asks the clock when connection and header are behind it: what is left is one write.
  /// @return what the velocity was then.
  Result<Twist2> put_velocity(const TimedVelocity& velocity);
  Result<Odometry> odometry();
  Result<std::vector<double>> distances();

 private:
  class Client;
  std::unique_ptr<Client> client_;
};

}  // namespace hal::robot::drivers
