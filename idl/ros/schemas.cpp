#include "idl/ros/schemas.h"

#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace idl::ros {
namespace {

/// Fields and constants by package/Name, from the .msg files of builtin_interfaces
/// (ros2/rcl_interfaces), std_msgs, geometry_msgs, nav_msgs, sensor_msgs, visualization_msgs
/// (ros2/common_interfaces) and tf2_msgs (ros2/geometry2), without their comments; and those of
/// this project.
constexpr std::pair<std::string_view, std::string_view> kDefinitions[] = {
    {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    {"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n"},
    {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    {"std_msgs/Bool", "bool data\n"},
    {"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n"},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"},
    {"geometry_msgs/Pose", "Point position\nQuaternion orientation\n"},
    {"geometry_msgs/PoseStamped", "std_msgs/Header header\nPose pose\n"},
    {"geometry_msgs/PoseWithCovariance", "Pose pose\nfloat64[36] covariance\n"},
    {"geometry_msgs/Twist", "Vector3 linear\nVector3 angular\n"},
    {"geometry_msgs/TwistWithCovariance", "Twist twist\nfloat64[36] covariance\n"},
    {"geometry_msgs/Transform", "Vector3 translation\nQuaternion rotation\n"},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\nTransform transform\n"},
    {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    {"nav_msgs/Odometry",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
     "geometry_msgs/TwistWithCovariance twist\n"},
    {"sensor_msgs/Range",
     "std_msgs/Header header\nuint8 ULTRASOUND=0\nuint8 INFRARED=1\nuint8 radiation_type\n"
     "float32 field_of_view\nfloat32 min_range\nfloat32 max_range\nfloat32 range\n"},
    {"sensor_msgs/LaserScan",
     "std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\n"
     "float32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\n"
     "float32[] ranges\nfloat32[] intensities\n"},
    {"sensor_msgs/Imu",
     "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\n"
     "float64[9] orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\n"
     "float64[9] angular_velocity_covariance\ngeometry_msgs/Vector3 linear_acceleration\n"
     "float64[9] linear_acceleration_covariance\n"},
    {"sensor_msgs/BatteryState",
     "uint8 POWER_SUPPLY_STATUS_UNKNOWN=0\nuint8 POWER_SUPPLY_STATUS_CHARGING=1\n"
     "uint8 POWER_SUPPLY_STATUS_DISCHARGING=2\nuint8 POWER_SUPPLY_STATUS_NOT_CHARGING=3\n"
     "uint8 POWER_SUPPLY_STATUS_FULL=4\nuint8 POWER_SUPPLY_HEALTH_UNKNOWN=0\n"
     "uint8 POWER_SUPPLY_HEALTH_GOOD=1\nuint8 POWER_SUPPLY_HEALTH_OVERHEAT=2\n"
     "uint8 POWER_SUPPLY_HEALTH_DEAD=3\nuint8 POWER_SUPPLY_HEALTH_OVERVOLTAGE=4\n"
     "uint8 POWER_SUPPLY_HEALTH_UNSPEC_FAILURE=5\nuint8 POWER_SUPPLY_HEALTH_COLD=6\n"
     "uint8 POWER_SUPPLY_HEALTH_WATCHDOG_TIMER_EXPIRE=7\n"
     "uint8 POWER_SUPPLY_HEALTH_SAFETY_TIMER_EXPIRE=8\n"
     "uint8 POWER_SUPPLY_TECHNOLOGY_UNKNOWN=0\nuint8 POWER_SUPPLY_TECHNOLOGY_NIMH=1\n"
     "uint8 POWER_SUPPLY_TECHNOLOGY_LION=2\nuint8 POWER_SUPPLY_TECHNOLOGY_LIPO=3\n"
     "uint8 POWER_SUPPLY_TECHNOLOGY_LIFE=4\nuint8 POWER_SUPPLY_TECHNOLOGY_NICD=5\n"
     "uint8 POWER_SUPPLY_TECHNOLOGY_LIMN=6\nstd_msgs/Header header\nfloat32 voltage\n"
     "float32 temperature\nfloat32 current\nfloat32 charge\nfloat32 capacity\n"
     "float32 design_capacity\nfloat32 percentage\nuint8 power_supply_status\n"
     "uint8 power_supply_health\nuint8 power_supply_technology\nbool present\n"
     "float32[] cell_voltage\nfloat32[] cell_temperature\nstring location\n"
     "string serial_number\n"},
    {"sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"},
    {"visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n"},
    {"visualization_msgs/MeshFile", "string filename\nuint8[] data\n"},
    {"visualization_msgs/Marker",
     "int32 ARROW=0\nint32 CUBE=1\nint32 SPHERE=2\nint32 CYLINDER=3\nint32 LINE_STRIP=4\n"
     "int32 LINE_LIST=5\nint32 CUBE_LIST=6\nint32 SPHERE_LIST=7\nint32 POINTS=8\n"
     "int32 TEXT_VIEW_FACING=9\nint32 MESH_RESOURCE=10\nint32 TRIANGLE_LIST=11\n"
     "int32 ADD=0\nint32 MODIFY=0\nint32 DELETE=2\nint32 DELETEALL=3\n"
     "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\n"
     "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\n"
     "builtin_interfaces/Duration lifetime\nbool frame_locked\ngeometry_msgs/Point[] points\n"
     "std_msgs/ColorRGBA[] colors\nstring texture_resource\n"
     "sensor_msgs/CompressedImage texture\nUVCoordinate[] uv_coordinates\nstring text\n"
     "string mesh_resource\nMeshFile mesh_file\nbool mesh_use_embedded_materials\n"},
    {"visualization_msgs/MarkerArray", "Marker[] markers\n"},
    {"baraka_msgs/Frame",
     "builtin_interfaces/Time stamp\nstring transmitter\nstring receiver\nstring frame_type\n"
     "uint16 sequence_number\nbool retry\nuint32 bits\nbuiltin_interfaces/Duration airtime\n"
     "uint32 skipped\nfloat64 rate\nstring modulation\nint16 mcs\nuint16 streams\nuint16 width\n"
     "uint16 guard_interval\nstring access_category\nuint32 ampdu\n"},
    {"baraka_msgs/MessageFate",
     "builtin_interfaces/Time stamp\nstring sender\nuint32 id\nstring node\nstring fate\n"
     "string verdict\n"},
    {"baraka_msgs/Route",
     "builtin_interfaces/Time stamp\nstring agent\nstring message_class\nstring destination\n"
     "string next_hop\nbool removed\nuint16 hops\nbuiltin_interfaces/Duration delay\n"
     "float64 min_snr_db\nfloat64 energy\n"},
    {"baraka_msgs/ControllerState", "builtin_interfaces/Time stamp\nstring agent\nstring state\n"},
    {"baraka_msgs/Value",
     "builtin_interfaces/Time stamp\nstring agent\nstring name\nfloat64 value\n"},
};

const std::map<std::string_view, std::string_view>& definitions() {
  static const std::map<std::string_view, std::string_view> all(std::begin(kDefinitions),
                                                                std::end(kDefinitions));
  return all;
}

/// Messages used in a definition, as package/Name, in its order.
std::vector<std::string> used_by(const std::string& type) {
  const std::string package = type.substr(0, type.find('/') + 1);
  std::string_view rest = definitions().at(type);
  std::vector<std::string> used;
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(line.size() + 1);
    const std::string field(line.substr(0, line.find_first_of(" [")));
    for (const std::string& name : {field, package + field}) {
      if (definitions().contains(name)) used.push_back(name);
    }
  }
  return used;
}

/// Adds the definitions on which `type` depends, directly or indirectly, each once.
void add_dependencies(const std::string& type, std::set<std::string>& known, std::string& text) {
  for (const std::string& name : used_by(type)) {
    if (!known.insert(name).second) continue;
    text += std::string(80, '=') + "\nMSG: " + name + '\n';
    text += definitions().at(name);
    add_dependencies(name, known, text);
  }
}

}  // namespace

std::string schema(std::string_view type) {
  // Inside definitions, "package/msg/Name" is written without "msg".
  std::string name(type);
  const std::size_t middle = name.find("/msg/");
  if (middle == std::string::npos) throw std::out_of_range("no message type: " + name);
  name.erase(middle, 4);
  std::string text(definitions().at(name));
  std::set<std::string> known{name};
  add_dependencies(name, known, text);
  return text;
}

}  // namespace idl::ros
