#pragma once

#include "hal/hardware/radio/udp_link.h"
#include "hal/hardware/robot_file.h"

namespace gateway {

/// The radio that a file asks for.
/// @param file, loop  outlive it.
/// @throws hal::config::ConfigErrors  what this computer does not have, with its place in the file:
///   trying again would not help.  @throws std::runtime_error  what may pass: the port is taken.
hal::hardware::UdpLink open_radio(const hal::hardware::RobotFile& file,
                                  hal::hardware::EventLoop& loop);

/// That the interface on which a file lets the controller open sockets is there, if it names one.
/// @throws hal::config::ConfigErrors
void require_air_interface(const hal::hardware::RobotFile& file);

}  // namespace gateway
