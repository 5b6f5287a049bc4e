#include "sim/report/ros_messages.h"

#include <cmath>
#include <limits>

#include "hal/types/math.h"
#include "sim/report/cdr.h"

namespace sim::report {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;
constexpr int kCovariances = 36, kCovariancesOfVector = 9;

/// A time or a duration.
void put_time(Cdr& out, std::int64_t ns) {
  out.put(static_cast<std::int32_t>(ns / kNsPerSecond));
  out.put(static_cast<std::uint32_t>(ns % kNsPerSecond));
}

void put_header(Cdr& out, const RosHeader& header) {
  put_time(out, header.at_ns);
  out.put(header.frame);
}

void put_vector(Cdr& out, const hal::Vec3& v) {
  out.put(v.x);
  out.put(v.y);
  out.put(v.z);
}

/// A turn about z as a unit quaternion.
void put_rotation(Cdr& out, double yaw) {
  put_vector(out, {0, 0, hal::math::sin(yaw / 2)});
  out.put(hal::math::cos(yaw / 2));
}

void put_pose(Cdr& out, const hal::Pose2& pose) {
  put_vector(out, {pose.x, pose.y, 0});
  put_rotation(out, pose.theta);
}

/// Not said.
void put_zeros(Cdr& out, int count) {
  for (int i = 0; i < count; ++i) out.put(0.0);
}

/// ROS REP 117: +infinity for nothing within reach, -infinity for too near.
void put_distance(Cdr& out, double metres) {
  out.put(std::isnan(metres) ? std::numeric_limits<float>::infinity() : static_cast<float>(metres));
}

void put_single(Cdr& out, double value) { out.put(static_cast<float>(value)); }

void put_colour(Cdr& out, const hal::Colour& colour) {
  out.put(colour.red);
  out.put(colour.green);
  out.put(colour.blue);
  out.put(1.0F);
}

void put_marker(Cdr& out, const RosMarker& marker) {
  const hal::Solid& solid = marker.solid;
  put_header(out, {marker.at_ns, "world"});
  out.put(marker.name);
  out.put(marker.id);
  out.put(static_cast<std::int32_t>(solid.shape));
  out.put(std::int32_t{0});  // ADD, and MODIFY if it is there
  put_vector(out, hal::centre_in_world(solid, marker.pose));
  put_rotation(out, marker.pose.theta + solid.yaw);
  put_vector(out, solid.size);
  put_colour(out, marker.colour);
  put_time(out, 0);  // until it is told otherwise
  out.put(false);    // frame_locked
  out.put_count(0);  // points
  out.put_count(0);  // colors
  out.put("");       // texture_resource
  put_header(out, {0, ""});
  out.put("");  // format of the texture
  out.put_count(0);
  out.put_count(0);  // uv_coordinates
  out.put("");       // text
  out.put("");       // mesh_resource
  out.put("");       // name of the mesh_file
  out.put_count(0);
  out.put(false);  // mesh_use_embedded_materials
}

}  // namespace

std::string pose_stamped(const RosHeader& header, const hal::Pose2& pose) {
  Cdr out;
  put_header(out, header);
  put_pose(out, pose);
  return out.bytes();
}

std::string tf_message(std::span<const RosTransform> transforms) {
  Cdr out;
  out.put_count(transforms.size());
  for (const RosTransform& one : transforms) {
    put_header(out, one.header);
    out.put(one.child);
    put_vector(out, one.translation);
    put_rotation(out, one.yaw);
  }
  return out.bytes();
}

std::string odometry(const RosHeader& header, std::string_view child, const hal::Pose2& pose,
                     const hal::Twist2& twist) {
  Cdr out;
  put_header(out, header);
  out.put(child);
  put_pose(out, pose);
  put_zeros(out, kCovariances);
  put_vector(out, {twist.vx, twist.vy, 0});
  put_vector(out, {0, 0, twist.omega});
  put_zeros(out, kCovariances);
  return out.bytes();
}

std::string range_message(const RosRange& range) {
  Cdr out;
  put_header(out, range.header);
  out.put(static_cast<std::uint8_t>(range.is_infrared));
  put_single(out, range.field_of_view);
  put_single(out, range.low);
  put_single(out, range.high);
  put_distance(out, range.range);
  return out.bytes();
}

std::string laser_scan(const RosScan& scan) {
  Cdr out;
  put_header(out, scan.header);
  put_single(out, scan.first);
  put_single(out, scan.last);
  put_single(out, scan.step);
  put_single(out, 0);  // all rays at once
  put_single(out, scan.period);
  put_single(out, scan.low);
  put_single(out, scan.high);
  out.put_count(scan.ranges.size());
  for (const double range : scan.ranges) put_distance(out, range);
  out.put_count(0);  // intensities
  return out.bytes();
}

std::string bool_message(bool value) {
  Cdr out;
  out.put(value);
  return out.bytes();
}

std::string imu_message(const RosHeader& header, const hal::Vec3& turn, const hal::Vec3& force) {
  Cdr out;
  put_header(out, header);
  put_zeros(out, 4);
  out.put(-1.0);  // It tells no orientation.
  put_zeros(out, kCovariancesOfVector - 1);
  put_vector(out, turn);
  put_zeros(out, kCovariancesOfVector);
  put_vector(out, force);
  put_zeros(out, kCovariancesOfVector);
  return out.bytes();
}

std::string battery_state(const RosHeader& header, const RosBattery& battery) {
  constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
  constexpr std::uint8_t kDischarging = 2, kUnknown = 0;
  Cdr out;
  put_header(out, header);
  put_single(out, battery.volts);
  put_single(out, kNotMeasured);  // temperature
  put_single(out, -battery.drawn_amperes);
  for (int i = 0; i < 3; ++i) put_single(out, kNotMeasured);  // charge, capacity, design_capacity
  put_single(out, battery.charge);
  out.put(kDischarging);
  out.put(kUnknown);  // health
  out.put(kUnknown);  // technology
  out.put(true);      // present
  out.put_count(0);   // cell_voltage
  out.put_count(0);   // cell_temperature
  out.put("");        // location
  out.put("");        // serial_number
  return out.bytes();
}

std::string route_message(const RosRoute& route) {
  Cdr out;
  put_time(out, route.at_ns);
  out.put(route.agent);
  out.put(route.topic);
  out.put(route.destination);
  out.put(route.next_hop);
  out.put(route.removed);
  out.put(route.hops);
  put_time(out, route.delay_ns);
  out.put(route.min_snr_db);
  out.put(route.energy);
  return out.bytes();
}

std::string marker_array(std::span<const RosMarker> markers) {
  Cdr out;
  out.put_count(markers.size());
  for (const RosMarker& marker : markers) put_marker(out, marker);
  return out.bytes();
}

std::string frame_message(const RosFrame& frame) {
  Cdr out;
  put_time(out, frame.at_ns);
  out.put(frame.transmitter);
  out.put(frame.receiver);
  out.put(frame.type);
  out.put(frame.sequence);
  out.put(frame.retry);
  out.put(frame.bits);
  put_time(out, frame.airtime_ns);
  out.put(std::uint32_t{0});  // skipped
  return out.bytes();
}

std::string message_fate(const RosFate& fate) {
  Cdr out;
  put_time(out, fate.at_ns);
  out.put(fate.sender);
  out.put(fate.id);
  out.put(fate.node);
  out.put(fate.fate);
  out.put(fate.verdict);
  return out.bytes();
}

std::string controller_state(std::int64_t at_ns, std::string_view agent, std::string_view state) {
  Cdr out;
  put_time(out, at_ns);
  out.put(agent);
  out.put(state);
  return out.bytes();
}

std::string value_message(std::int64_t at_ns, std::string_view agent, std::string_view name,
                          double value) {
  Cdr out;
  put_time(out, at_ns);
  out.put(agent);
  out.put(name);
  out.put(value);
  return out.bytes();
}

}  // namespace sim::report
