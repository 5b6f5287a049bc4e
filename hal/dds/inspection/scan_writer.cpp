#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hal/dds/inspection/channel_writers.h"
#include "hal/dds/inspection/typed_channel_writer.h"

namespace hal::dds {
namespace {

class ScanWriter final : public TypedWriter<sensor_msgs::msg::dds_::LaserScan_PubSubType> {
 public:
  explicit ScanWriter(const ChannelTopic& topic) : TypedWriter(topic) {
    const std::vector<double>& headings = topic.channel.headings;
    if (headings.empty()) return;
    const double step = headings.size() > 1 ? headings[1] - headings[0] : 0;
    sample().header().frame_id(topic.agent + "/" + topic.channel.frame);
    sample().angle_min(static_cast<float>(headings.front()));
    sample().angle_max(static_cast<float>(headings.back()));
    sample().angle_increment(static_cast<float>(step));
    sample().time_increment(0);  // all rays at once
    sample().scan_time(static_cast<float>(to_seconds(topic.channel.period)));
    sample().range_min(static_cast<float>(topic.channel.low));
    sample().range_max(static_cast<float>(topic.channel.high));
  }

 private:
  /// ROS REP 117: +infinity for nothing within reach, -infinity for too near.
  void fill(Time at, std::span<const double> values) override {
    sample().header().stamp(to_ros(at));
    sample().ranges().resize(values.size());
    std::ranges::transform(values, sample().ranges().begin(), [](double metres) {
      return std::isnan(metres) ? std::numeric_limits<float>::infinity()
                                : static_cast<float>(metres);
    });
  }
};

}  // namespace

std::unique_ptr<ChannelWriter> make_scan_writer(const ChannelTopic& topic) {
  return std::make_unique<ScanWriter>(topic);
}

}  // namespace hal::dds
