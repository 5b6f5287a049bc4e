#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace programs::models {

/// What is wrong with `drive:`; what() begins with the key: "drive.left: there is …".
class DriveError : public std::runtime_error {
 public:
  DriveError(const std::string& key, const std::string& what)
      : std::runtime_error(key + ": " + what) {}
};

/// `drive:` of a robot in URDF or SDF: which joints turn its wheels, by their names. Of a kind
/// there are none if its list is empty.
struct DriveChoice {
  std::vector<std::string> left, right;  ///< Ordinary wheels.
  std::vector<std::string> omni;
  std::vector<std::string> mecanum;
  double roller_angle = 0.78539816339744831;  ///< rad, > 0, of mecanum wheels.
  std::vector<std::string> casters;           ///< Names of links that are balls without a motor.

  bool names_wheels() const {
    return !left.empty() || !right.empty() || !omni.empty() || !mecanum.empty();
  }
};

/// @param text  a mapping of YAML: "{left: left_wheel_joint, right: [a, b]}". @throws DriveError
DriveChoice parse_drive(const std::string& text);

}  // namespace programs::models
