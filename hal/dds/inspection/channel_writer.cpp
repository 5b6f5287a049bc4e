#include "hal/dds/inspection/channel_writer.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "hal/dds/inspection/channel_writers.h"

namespace hal::dds {
namespace {

struct Kind {
  std::string_view name;
  std::unique_ptr<ChannelWriter> (*make)(const ChannelTopic& topic);
};

/// The one table from kinds of channels to types of ROS 2. Infrared and odometry, which are shown
/// unasked, have topics of their own in Inspector.
constexpr std::array kKinds{
    Kind{"pose", make_pose_writer},     Kind{"battery", make_battery_writer},
    Kind{"bumper", make_bumper_writer}, Kind{"imu", make_imu_writer},
    Kind{"scan", make_scan_writer},     Kind{"sonar", make_sonar_writer},
};

}  // namespace

std::unique_ptr<ChannelWriter> make_channel_writer(const ChannelTopic& topic) {
  const auto kind = std::ranges::find(kKinds, topic.channel.kind, &Kind::name);
  if (kind == kKinds.end()) return nullptr;
  return kind->make(topic);
}

}  // namespace hal::dds
