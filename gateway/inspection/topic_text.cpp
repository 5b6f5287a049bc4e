#include <fmt/format.h>

#include <cmath>
#include <map>

#include "gateway/guard/fastdds.h"
#include "gateway/inspection/topic_browser.h"
#include "hal/types/printable.h"
#include "inspectPubSubTypes.h"

namespace gateway::inspection {
namespace {

namespace ros_time = builtin_interfaces::msg::dds_;
namespace geometry = geometry_msgs::msg::dds_;
namespace visualization = visualization_msgs::msg::dds_;
namespace own = baraka_msgs::msg::dds_;

/// Lines of a YAML document.
class Lines {
 public:
  void open(std::string_view key) {
    line(fmt::format("{}:", key));
    ++depth_;
  }
  void close() { --depth_; }
  void begin_item() { item_ = true, ++depth_; }
  void end_item() { --depth_; }

  void put(std::string_view key, const std::string& text) {
    std::string quoted;
    for (const char c : text) {
      if (c == '"' || c == '\\') quoted += '\\';
      quoted += c;
    }
    quoted = hal::printable(quoted);
    line(fmt::format("{}: \"{}\"", key, quoted));
  }
  void put(std::string_view key, bool flag) { line(fmt::format("{}: {}", key, flag)); }
  void put(std::string_view key, double value) { line(fmt::format("{}: {}", key, number(value))); }
  void put(std::string_view key, float value) { line(fmt::format("{}: {}", key, number(value))); }
  template <std::integral Integer>
  void put(std::string_view key, Integer value) {
    line(fmt::format("{}: {}", key, value));
  }
  template <std::size_t n>
  void put(std::string_view key, const std::array<double, n>& values) {
    put_list(key, values);
  }
  void put(std::string_view key, const std::vector<float>& values) { put_list(key, values); }
  void put(std::string_view key, const std::vector<std::uint8_t>& bytes) {
    line(fmt::format("{}: [{}]", key, fmt::join(bytes, ", ")));
  }

  std::string take() { return std::move(text_); }

 private:
  /// Shortest text that reads back the same; a template, because single precision needs fewer
  /// digits.
  template <std::floating_point Number>
  static std::string number(Number value) {
    if (std::isnan(value)) return ".nan";
    if (std::isinf(value)) return value < 0 ? "-.inf" : ".inf";
    return fmt::format("{}", value);
  }
  template <class List>
  void put_list(std::string_view key, const List& values) {
    std::string list;
    for (const auto value : values) list += (list.empty() ? "" : ", ") + number(value);
    line(fmt::format("{}: [{}]", key, list));
  }
  void line(const std::string& text) {
    const std::size_t indent = 2 * depth_;
    text_ += item_ ? std::string(indent - 2, ' ') + "- " : std::string(indent, ' ');
    text_ += text + '\n';
    item_ = false;
  }

  std::string text_;
  std::size_t depth_ = 0;
  bool item_ = false;  ///< The next line begins with the dash of a list item.
};

template <class Message>
void put(Lines& out, std::string_view key, const Message& message);
template <class Message>
void put_sequence(Lines& out, std::string_view key, const std::vector<Message>& messages);

void put_members(Lines& out, const ros_time::Time_& m) {
  out.put("sec", m.sec());
  out.put("nanosec", m.nanosec());
}
void put_members(Lines& out, const ros_time::Duration_& m) {
  out.put("sec", m.sec());
  out.put("nanosec", m.nanosec());
}
void put_members(Lines& out, const std_msgs::msg::dds_::Bool_& m) { out.put("data", m.data()); }
void put_members(Lines& out, const std_msgs::msg::dds_::Header_& m) {
  put(out, "stamp", m.stamp());
  out.put("frame_id", m.frame_id());
}
void put_members(Lines& out, const rosgraph_msgs::msg::dds_::Clock_& m) {
  put(out, "clock", m.clock());
}

template <class Xyz>
void put_xyz(Lines& out, const Xyz& m) {
  out.put("x", m.x());
  out.put("y", m.y());
  out.put("z", m.z());
}
void put_members(Lines& out, const geometry::Vector3_& m) { put_xyz(out, m); }
void put_members(Lines& out, const geometry::Point_& m) { put_xyz(out, m); }
void put_members(Lines& out, const geometry::Quaternion_& m) {
  put_xyz(out, m);
  out.put("w", m.w());
}
void put_members(Lines& out, const geometry::Transform_& m) {
  put(out, "translation", m.translation());
  put(out, "rotation", m.rotation());
}
void put_members(Lines& out, const geometry::TransformStamped_& m) {
  put(out, "header", m.header());
  out.put("child_frame_id", m.child_frame_id());
  put(out, "transform", m.transform());
}
void put_members(Lines& out, const geometry::Pose_& m) {
  put(out, "position", m.position());
  put(out, "orientation", m.orientation());
}
void put_members(Lines& out, const geometry::PoseStamped_& m) {
  put(out, "header", m.header());
  put(out, "pose", m.pose());
}
void put_members(Lines& out, const geometry::PoseWithCovariance_& m) {
  put(out, "pose", m.pose());
  out.put("covariance", m.covariance());
}
void put_members(Lines& out, const geometry::Twist_& m) {
  put(out, "linear", m.linear());
  put(out, "angular", m.angular());
}
void put_members(Lines& out, const geometry::TwistWithCovariance_& m) {
  put(out, "twist", m.twist());
  out.put("covariance", m.covariance());
}
void put_members(Lines& out, const tf2_msgs::msg::dds_::TFMessage_& m) {
  put_sequence(out, "transforms", m.transforms());
}
void put_members(Lines& out, const std_msgs::msg::dds_::ColorRGBA_& m) {
  out.put("r", m.r());
  out.put("g", m.g());
  out.put("b", m.b());
  out.put("a", m.a());
}
void put_members(Lines& out, const sensor_msgs::msg::dds_::CompressedImage_& m) {
  put(out, "header", m.header());
  out.put("format", m.format());
  out.put("data", m.data());
}
void put_members(Lines& out, const visualization::UVCoordinate_& m) {
  out.put("u", m.u());
  out.put("v", m.v());
}
void put_members(Lines& out, const visualization::MeshFile_& m) {
  out.put("filename", m.filename());
  out.put("data", m.data());
}
void put_members(Lines& out, const visualization::Marker_& m) {
  put(out, "header", m.header());
  out.put("ns", m.ns());
  out.put("id", m.id());
  out.put("type", m.type());
  out.put("action", m.action());
  put(out, "pose", m.pose());
  put(out, "scale", m.scale());
  put(out, "color", m.color());
  put(out, "lifetime", m.lifetime());
  out.put("frame_locked", m.frame_locked());
  put_sequence(out, "points", m.points());
  put_sequence(out, "colors", m.colors());
  out.put("texture_resource", m.texture_resource());
  put(out, "texture", m.texture());
  put_sequence(out, "uv_coordinates", m.uv_coordinates());
  out.put("text", m.text());
  out.put("mesh_resource", m.mesh_resource());
  put(out, "mesh_file", m.mesh_file());
  out.put("mesh_use_embedded_materials", m.mesh_use_embedded_materials());
}
void put_members(Lines& out, const visualization::MarkerArray_& m) {
  put_sequence(out, "markers", m.markers());
}
void put_members(Lines& out, const nav_msgs::msg::dds_::Odometry_& m) {
  put(out, "header", m.header());
  out.put("child_frame_id", m.child_frame_id());
  put(out, "pose", m.pose());
  put(out, "twist", m.twist());
}
void put_members(Lines& out, const sensor_msgs::msg::dds_::Range_& m) {
  put(out, "header", m.header());
  out.put("radiation_type", m.radiation_type());
  out.put("field_of_view", m.field_of_view());
  out.put("min_range", m.min_range());
  out.put("max_range", m.max_range());
  out.put("range", m.range());
}
void put_members(Lines& out, const sensor_msgs::msg::dds_::LaserScan_& m) {
  put(out, "header", m.header());
  out.put("angle_min", m.angle_min());
  out.put("angle_max", m.angle_max());
  out.put("angle_increment", m.angle_increment());
  out.put("time_increment", m.time_increment());
  out.put("scan_time", m.scan_time());
  out.put("range_min", m.range_min());
  out.put("range_max", m.range_max());
  out.put("ranges", m.ranges());
  out.put("intensities", m.intensities());
}
void put_members(Lines& out, const sensor_msgs::msg::dds_::Imu_& m) {
  put(out, "header", m.header());
  put(out, "orientation", m.orientation());
  out.put("orientation_covariance", m.orientation_covariance());
  put(out, "angular_velocity", m.angular_velocity());
  out.put("angular_velocity_covariance", m.angular_velocity_covariance());
  put(out, "linear_acceleration", m.linear_acceleration());
  out.put("linear_acceleration_covariance", m.linear_acceleration_covariance());
}
void put_members(Lines& out, const sensor_msgs::msg::dds_::BatteryState_& m) {
  put(out, "header", m.header());
  out.put("voltage", m.voltage());
  out.put("temperature", m.temperature());
  out.put("current", m.current());
  out.put("charge", m.charge());
  out.put("capacity", m.capacity());
  out.put("design_capacity", m.design_capacity());
  out.put("percentage", m.percentage());
  out.put("power_supply_status", m.power_supply_status());
  out.put("power_supply_health", m.power_supply_health());
  out.put("power_supply_technology", m.power_supply_technology());
  out.put("present", m.present());
  out.put("cell_voltage", m.cell_voltage());
  out.put("cell_temperature", m.cell_temperature());
  out.put("location", m.location());
  out.put("serial_number", m.serial_number());
}
void put_members(Lines& out, const own::MessageFate_& m) {
  put(out, "stamp", m.stamp());
  out.put("sender", m.sender());
  out.put("id", m.id());
  out.put("node", m.node());
  out.put("fate", m.fate());
  out.put("verdict", m.verdict());
}
void put_members(Lines& out, const own::Frame_& m) {
  put(out, "stamp", m.stamp());
  out.put("transmitter", m.transmitter());
  out.put("receiver", m.receiver());
  out.put("frame_type", m.frame_type());
  out.put("sequence_number", m.sequence_number());
  out.put("retry", m.retry());
  out.put("bits", m.bits());
  put(out, "airtime", m.airtime());
  out.put("skipped", m.skipped());
  out.put("rate", m.rate());
  out.put("modulation", m.modulation());
  out.put("mcs", m.mcs());
  out.put("streams", m.streams());
  out.put("width", m.width());
  out.put("guard_interval", m.guard_interval());
  out.put("access_category", m.access_category());
  out.put("ampdu", m.ampdu());
}
void put_members(Lines& out, const own::Route_& m) {
  put(out, "stamp", m.stamp());
  out.put("agent", m.agent());
  out.put("message_class", m.message_class());
  out.put("destination", m.destination());
  out.put("next_hop", m.next_hop());
  out.put("removed", m.removed());
  out.put("hops", m.hops());
  put(out, "delay", m.delay());
  out.put("min_snr_db", m.min_snr_db());
  out.put("energy", m.energy());
}
void put_members(Lines& out, const own::ControllerState_& m) {
  put(out, "stamp", m.stamp());
  out.put("agent", m.agent());
  out.put("state", m.state());
}
void put_members(Lines& out, const own::Value_& m) {
  put(out, "stamp", m.stamp());
  out.put("agent", m.agent());
  out.put("name", m.name());
  out.put("value", m.value());
}
void put_members(Lines& out, const own::LinkQuality_& m) {
  put(out, "stamp", m.stamp());
  out.put("receiver", m.receiver());
  out.put("transmitter", m.transmitter());
  out.put("rssi_dbm", m.rssi_dbm());
  out.put("delivered", m.delivered());
  out.put("lost", m.lost());
}
void put_members(Lines& out, const own::AirTopic_& m) {
  put(out, "stamp", m.stamp());
  out.put("topic", m.topic());
  out.put("samples", m.samples());
  out.put("delivered", m.delivered());
  out.put("first_try", m.first_try());
  out.put("repaired", m.repaired());
  put(out, "latency_median", m.latency_median());
  put(out, "latency_p99", m.latency_p99());
  put(out, "airtime", m.airtime());
  out.put("share", m.share());
}
void put_members(Lines& out, const own::AirKind_& m) {
  put(out, "stamp", m.stamp());
  out.put("purpose", m.purpose());
  out.put("kind", m.kind());
  out.put("port", m.port());
  out.put("frames", m.frames());
  out.put("retries", m.retries());
  out.put("submessages", m.submessages());
  out.put("bits", m.bits());
  put(out, "airtime", m.airtime());
  out.put("share", m.share());
}

template <class Message>
void put(Lines& out, std::string_view key, const Message& message) {
  out.open(key);
  put_members(out, message);
  out.close();
}

template <class Message>
void put_sequence(Lines& out, std::string_view key, const std::vector<Message>& messages) {
  out.open(key);
  for (const Message& one : messages) {
    out.begin_item();
    put_members(out, one);
    out.end_item();
  }
  out.close();
}

template <class PubSub>
std::optional<std::string> decode(const hal::Bytes& sample) {
  PubSub type;
  typename PubSub::type value;
  guard::rtps::SerializedPayload_t payload(static_cast<std::uint32_t>(sample.size()));
  std::ranges::copy(sample, payload.data);
  payload.length = payload.max_size;
  try {
    if (!type.deserialize(&payload, &value)) return std::nullopt;
  } catch (const std::exception&) {  // for example a list whose stated length exceeds memory
    return std::nullopt;
  }
  Lines out;
  put_members(out, value);
  return out.take();
}

using Decoder = std::optional<std::string> (*)(const hal::Bytes&);

template <class... PubSub>
std::map<std::string, Decoder> decoders() {
  return {{std::string(PubSub().getName()), &decode<PubSub>}...};
}

}  // namespace

std::optional<std::string> to_yaml(const std::string& type, const hal::Bytes& sample) {
  static const std::map<std::string, Decoder> all =
      decoders<rosgraph_msgs::msg::dds_::Clock_PubSubType, std_msgs::msg::dds_::Bool_PubSubType,
               tf2_msgs::msg::dds_::TFMessage_PubSubType, nav_msgs::msg::dds_::Odometry_PubSubType,
               visualization::MarkerArray_PubSubType, sensor_msgs::msg::dds_::Range_PubSubType,
               sensor_msgs::msg::dds_::LaserScan_PubSubType, sensor_msgs::msg::dds_::Imu_PubSubType,
               sensor_msgs::msg::dds_::BatteryState_PubSubType, geometry::Twist_PubSubType,
               geometry::PoseStamped_PubSubType, own::MessageFate_PubSubType, own::Frame_PubSubType,
               own::Route_PubSubType, own::ControllerState_PubSubType, own::LinkQuality_PubSubType,
               own::Value_PubSubType, own::AirTopic_PubSubType, own::AirKind_PubSubType>();
  const auto found = all.find(type);
  return found == all.end() ? std::nullopt : found->second(sample);
}

}  // namespace gateway::inspection
