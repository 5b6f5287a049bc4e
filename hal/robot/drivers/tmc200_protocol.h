#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "hal/node/devices/robot_description.h"
#include "hal/robot/drivers/device_times.h"
#include "hal/types/result.h"

namespace hal::robot::drivers {

/// Fraunhofer AiS TMC200 triple motor controller on a serial line, 57600 8N1.
struct Tmc200Settings {
  struct Motor {
    int encoder_lines = 0;  ///< Per turn of the motor shaft, > 0.
    double gear = 1;        ///< Turns of the motor per turn of the wheel, > 0.
    double max_speed = 0;   ///< rad/s of the motor shaft, > 0: the controller's full scale.
    bool inverted = false;  ///< Wired so that it turns against the wheel's positive direction.
    bool operator==(const Motor&) const = default;
  };
  std::string device;  ///< E.g. "/dev/ttyUSB0".
  Motor motor;         ///< Common to all three motors, in the order of the robot's wheels.
  Duration cut_off{};  ///< The controller stops the motors after this silence; 10 ms .. 2.55 s.
  DeviceTimes times;   ///< Period <= cut_off / 2.
  bool operator==(const Tmc200Settings&) const = default;
};

/// The line protocol of Fraunhofer AiS's TMC200 triple motor controller: a command, its arguments,
/// a blank, a line feed. Sources: the command list of libtmc200ctrl (Fraunhofer AiS users' library,
/// 2013); scale and answers as used by the driver of the RoboCup team Brainstormers Tribots
/// (University of Osnabrueck, 2005).
///
///   SMODE 1              closed speed loop                                        → OK
///   SMZNM n              motors off after n * 10 ms without a command             → OK
///   SENCO Mi r v d       2 * encoder lines, full-scale speed [rpm], half micro-
///                        metres of travel per encoder step                        → OK
///   SSEND 1              answer SV with the measured speeds                       → OK
///   SV a b c             speeds of the motors, 1024 = full scale                  → V a b c
class Tmc200Protocol {
 public:
  using Speeds = std::array<int, 3>;  ///< 1/1024 of the full scale, -1024 … 1024.
  static constexpr int kFullScale = 1024;

  /// @pre the robot has three wheels.
  Tmc200Protocol(const Tmc200Settings& settings, const node::devices::RobotDescription& robot);

  /// Commands that set the controller up, each answered by "OK".
  std::vector<std::string> set_up() const;

  /// @param wheels  rad/s, three of them; limited to the full scale.
  std::string set_speeds(const std::vector<double>& wheels) const;

  static bool is_ok(std::string_view line);

  /// The measured speeds of the wheels [rad/s] from the answer to SV, which may continue with other
  /// values after a tab. Errors: kProtocol.
  Result<std::vector<double>> measured(std::string_view line) const;

 private:
  /// One unit of speed at the wheel, rad/s, with the sign of the motors' wiring.
  double unit() const;
  int full_scale_rpm() const;

  Tmc200Settings settings_;
  std::array<double, 3> radii_{};  ///< m
};

}  // namespace hal::robot::drivers
