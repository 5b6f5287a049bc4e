#include "hal/dds/inspection/channel_writers.h"
#include "hal/dds/inspection/typed_channel_writer.h"

namespace hal::dds {
namespace {

class PoseWriter final : public TypedWriter<geometry_msgs::msg::dds_::PoseStamped_PubSubType> {
 public:
  using TypedWriter::TypedWriter;

 private:
  void fill(Time at, std::span<const double> values) override {
    sample().header().stamp(to_ros(at));
    sample().header().frame_id("world");
    sample().pose(to_ros(Pose2{values[0], values[1], values[2]}));
  }
};

}  // namespace

std::unique_ptr<ChannelWriter> make_pose_writer(const ChannelTopic& topic) {
  return std::make_unique<PoseWriter>(topic);
}

}  // namespace hal::dds
