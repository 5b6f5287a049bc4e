#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <string>
#include <string_view>

#include "inspect.h"

namespace idl::ros {

/// ROS 2 name of a message type: "sensor_msgs/msg/LaserScan".
template <class Message>
inline constexpr std::string_view kTypeName;
template <>
inline constexpr std::string_view kTypeName<std_msgs::msg::dds_::Bool_> = "std_msgs/msg/Bool";
template <>
inline constexpr std::string_view kTypeName<geometry_msgs::msg::dds_::PoseStamped_> =
    "geometry_msgs/msg/PoseStamped";
template <>
inline constexpr std::string_view kTypeName<tf2_msgs::msg::dds_::TFMessage_> =
    "tf2_msgs/msg/TFMessage";
template <>
inline constexpr std::string_view kTypeName<nav_msgs::msg::dds_::Odometry_> =
    "nav_msgs/msg/Odometry";
template <>
inline constexpr std::string_view kTypeName<sensor_msgs::msg::dds_::Range_> =
    "sensor_msgs/msg/Range";
template <>
inline constexpr std::string_view kTypeName<sensor_msgs::msg::dds_::Imu_> = "sensor_msgs/msg/Imu";
template <>
inline constexpr std::string_view kTypeName<sensor_msgs::msg::dds_::BatteryState_> =
    "sensor_msgs/msg/BatteryState";
template <>
inline constexpr std::string_view kTypeName<sensor_msgs::msg::dds_::LaserScan_> =
    "sensor_msgs/msg/LaserScan";
template <>
inline constexpr std::string_view kTypeName<visualization_msgs::msg::dds_::MarkerArray_> =
    "visualization_msgs/msg/MarkerArray";
template <>
inline constexpr std::string_view kTypeName<baraka_msgs::msg::dds_::Frame_> =
    "baraka_msgs/msg/Frame";
template <>
inline constexpr std::string_view kTypeName<baraka_msgs::msg::dds_::MessageFate_> =
    "baraka_msgs/msg/MessageFate";
template <>
inline constexpr std::string_view kTypeName<baraka_msgs::msg::dds_::Route_> =
    "baraka_msgs/msg/Route";
template <>
inline constexpr std::string_view kTypeName<baraka_msgs::msg::dds_::ControllerState_> =
    "baraka_msgs/msg/ControllerState";
template <>
inline constexpr std::string_view kTypeName<baraka_msgs::msg::dds_::Value_> =
    "baraka_msgs/msg/Value";

/// Writes a message as Fast DDS transmits it: plain CDR, little endian, after four bytes that
/// declare this encoding (OMG DDS-XTypes 1.3, 7.4.1 and 7.6.3.1.2).
/// @param bytes  replaced by the message.
template <class Message>
void write_cdr(const Message& message, std::string& bytes) {
  constexpr std::size_t kEncapsulation = 4;
  // Fast CDR skips padding without writing it; zeros make equal messages equal bytes.
  bytes.assign(kEncapsulation + Message::getCdrSerializedSize(message), '\0');
  eprosima::fastcdr::FastBuffer buffer(bytes.data(), bytes.size());
  eprosima::fastcdr::Cdr out(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS,
                             eprosima::fastcdr::Cdr::DDS_CDR);
  out.serialize_encapsulation();
  message.serialize(out);
  bytes.resize(out.getSerializedDataLength());
}

}  // namespace idl::ros
