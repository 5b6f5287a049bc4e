#include "hal/dds/inspection/channel_writers.h"
#include "hal/dds/inspection/typed_channel_writer.h"

namespace hal::dds {
namespace {

class ImuWriter final : public TypedWriter<sensor_msgs::msg::dds_::Imu_PubSubType> {
 public:
  explicit ImuWriter(const ChannelTopic& topic) : TypedWriter(topic) {
    sample().header().frame_id(topic.agent + "/" + topic.channel.frame);
    sample().orientation_covariance()[0] = -1;  // it tells no orientation
  }

 private:
  void fill(Time at, std::span<const double> values) override {
    sample().header().stamp(to_ros(at));
    sample().angular_velocity(vector(values.first(3)));
    sample().linear_acceleration(vector(values.last(3)));
  }

  static geometry_msgs::msg::dds_::Vector3_ vector(std::span<const double> values) {
    geometry_msgs::msg::dds_::Vector3_ result;
    result.x(values[0]);
    result.y(values[1]);
    result.z(values[2]);
    return result;
  }
};

}  // namespace

std::unique_ptr<ChannelWriter> make_imu_writer(const ChannelTopic& topic) {
  return std::make_unique<ImuWriter>(topic);
}

}  // namespace hal::dds
