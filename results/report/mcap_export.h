#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "results/report/exported_scene.h"

namespace results::report {

/// Writes a result as an MCAP file of ROS 2 messages, sorted by simulated time. Topics have the
/// same names as those that a running simulation publishes (gateway/inspection/inspector.h),
/// without `rt`:
///
/// topic                       type                            from
/// /tf                         tf2_msgs/TFMessage              poses, one per instant
/// /tf_static                  tf2_msgs/TFMessage              the scene, once
/// /<agent>/pose               geometry_msgs/PoseStamped       poses of all but motes
/// /markers                    visualization_msgs/MarkerArray  walls once; poses, one per instant
/// /<agent>/odom               nav_msgs/Odometry               readings, else observables
/// /<agent>/range              sensor_msgs/Range               likewise, one per infrared sensor
/// /<agent>/<sensor>           by its kind: sensor_message.h   readings of `sensors:`
/// /baraka/frames              baraka_msgs/Frame               frames
/// /baraka/routes              baraka_msgs/Route               routes
/// /baraka/message_fates       baraka_msgs/MessageFate         messages with a fate, and deliveries
/// /baraka/controller_states   baraka_msgs/ControllerState     states
/// /baraka/values              baraka_msgs/Value               recorded
///
/// A topic without messages is left out. If a sensor is named pose, /<agent>/pose carries its
/// readings and /<agent>/true_pose the poses. The metadata record `baraka` holds the table `run`.
/// @param write  receives the file piece by piece.
/// @return number of messages written.
/// @throws std::runtime_error  the folder has no result of this version.
std::uint64_t write_mcap(const std::filesystem::path& folder, const ExportedScene& scene,
                         const std::function<void(std::string_view)>& write);

}  // namespace results::report
