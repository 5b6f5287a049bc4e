#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/types/time.h"

namespace hal::hardware {

/// What a driver may assume of its device: how long it waits for an answer, how often it asks, and
/// which age of a reading is too old: the channel is lost then.
struct DeviceTimes {
  Duration period{};       ///< > 0
  Duration timeout{};      ///< > 0
  Duration stale_after{};  ///< > period
  bool operator==(const DeviceTimes&) const = default;
};

/// Festo Robotino 3 or 4 over its REST interface (wiki.openrobotino.org/Rest_api.html).
struct RobotinoSettings {
  std::string host;  ///< Name or address.
  std::uint16_t port = 80;
  std::string session = "baraka";  ///< `sid` of the requests.
  DeviceTimes times;               ///< Period <= 100 ms: the robot stops after 200 ms of silence.
  // Infrared only. Firmware differs, so the file says what the array gives.
  bool in_volts = false;   ///< Volts instead of metres.
  bool clockwise = false;  ///< Sensor i looks along -40 deg * i instead of 40 deg * i.
  bool operator==(const RobotinoSettings&) const = default;
};

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
  Motor motor;         ///< All three are alike, in the order of the robot's wheels.
  Duration cut_off{};  ///< The controller stops the motors after this silence; 10 ms .. 2.55 s.
  DeviceTimes times;   ///< Period <= cut_off / 2.
  bool operator==(const Tmc200Settings&) const = default;
};

/// Sensors on an analog-to-digital converter of Linux's Industrial I/O subsystem.
struct IioSettings {
  std::filesystem::path folder;       ///< E.g. "/sys/bus/iio/devices/iio:device0".
  std::vector<std::string> channels;  ///< E.g. "voltage0", one per sensor of the robot.
  DeviceTimes times;
  bool operator==(const IioSettings&) const = default;
};

}  // namespace hal::hardware
