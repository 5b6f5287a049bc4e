#pragma once

#include "hal/robot/agent/robot_file.h"
#include "hal/robot/radio/udp_link.h"

namespace agentd {

/// Opens the radio that a file asks for.
/// @param file, loop  outlive it.
/// @throws hal::files::config::ConfigErrors  what this computer does not have, with the position in
/// the file: trying again would not help.
/// @throws std::runtime_error  a condition that may be temporary: the port is taken.
hal::robot::radio::UdpLink open_radio(const hal::robot::agent::RobotFile& file,
                                      hal::robot::platform::EventLoop& loop);

/// Checks that the interface on which the file lets the controller open sockets exists, if it names
/// one.
/// @throws hal::files::config::ConfigErrors
void require_air_interface(const hal::robot::agent::RobotFile& file);

}  // namespace agentd
