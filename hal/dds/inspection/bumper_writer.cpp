#include "hal/dds/inspection/channel_writers.h"
#include "hal/dds/inspection/typed_channel_writer.h"

namespace hal::dds {
namespace {

class BumperWriter final : public TypedWriter<std_msgs::msg::dds_::Bool_PubSubType> {
 public:
  using TypedWriter::TypedWriter;

 private:
  void fill(Time, std::span<const double> values) override { sample().data(values[0] != 0); }
};

}  // namespace

std::unique_ptr<ChannelWriter> make_bumper_writer(const ChannelTopic& topic) {
  return std::make_unique<BumperWriter>(topic);
}

}  // namespace hal::dds
