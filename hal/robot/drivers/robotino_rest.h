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
/// API", wiki.openrobotino.org/Rest_api.html). Base `/data/`; the parameter `sid` names the client:
///
///   PUT omnidrive             [vx, vy, omega]                        m/s, rad/s; body frame
///   GET odometry              [x, y, rot, vx, vy, omega, sequence]   m, rad, m/s, rad/s
///   GET distancesensorarray   nine numbers, sensor i at i * 40 deg
///
/// Every call waits for the answer, at most the settings' time-out for the connection and the same
/// again for the exchange. Errors: kNotConnected; kTimeout (also for an answer of more than 16 kB,
/// which would not end in time); kProtocol (a status outside 200 … 299, or an unexpected body). One
/// thread.
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

  /// Evaluates the velocity after connecting and sending the header, right before the last write.
  /// @return the velocity that was sent.
  Result<Twist2> put_velocity(const TimedVelocity& velocity);
  Result<Odometry> odometry();
  Result<std::vector<double>> distances();

 private:
  class Client;
  std::unique_ptr<Client> client_;
};

}  // namespace hal::robot::drivers
