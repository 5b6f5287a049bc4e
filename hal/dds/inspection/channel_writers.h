#pragma once

#include <memory>

#include "hal/dds/inspection/channel_writer.h"

namespace hal::dds {

// Writers by the kind of the channel, each in a file of its own; @throws std::runtime_error

std::unique_ptr<ChannelWriter> make_scan_writer(const ChannelTopic& topic);  // LaserScan
std::unique_ptr<ChannelWriter> make_pose_writer(const ChannelTopic& topic);  // PoseStamped
std::unique_ptr<ChannelWriter> make_battery_writer(const ChannelTopic& topic);
std::unique_ptr<ChannelWriter> make_bumper_writer(const ChannelTopic& topic);  // Bool
std::unique_ptr<ChannelWriter> make_imu_writer(const ChannelTopic& topic);     // Imu
std::unique_ptr<ChannelWriter> make_sonar_writer(const ChannelTopic& topic);   // Range

}  // namespace hal::dds
