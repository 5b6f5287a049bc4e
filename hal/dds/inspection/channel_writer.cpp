#include "hal/dds/inspection/channel_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <vector>

#include "hal/dds/inspection/inspection_endpoints.h"
#include "hal/dds/inspection/inspection_values.h"
#include "inspectPubSubTypes.h"

namespace hal::dds {
namespace {

constexpr int kChannelSamples = 10;  // kept for a reader that is busy for a moment

/// A writer of samples of one type.
template <class PubSub>
class TypedWriter : public ChannelWriter {
 public:
  TypedWriter(Participant& participant, const std::string& agent, const Channel& channel,
              std::atomic<int>& readers)
      : writer_(participant, "rt/" + agent + "/" + channel.name, kChannelSamples, readers),
        length_(channel.length),
        period_(channel.period) {}

  bool has_readers() const noexcept override { return writer_.has_readers(); }

  void publish(Time at, std::span<const double> values) override {
    if (values.size() != length_ || is_same_measurement(at, values)) return;
    shown_.assign(values.begin(), values.end());
    shown_at_ = at;
    fill(at, values);
    writer_.write();
  }

 protected:
  auto& sample() { return writer_.sample(); }
  virtual void fill(Time at, std::span<const double> values) = 0;

 private:
  /// Whether they are the values shown last, held while the sensor measures the next ones. Bit by
  /// bit: a value may be NaN.
  bool is_same_measurement(Time at, std::span<const double> values) const {
    return shown_.size() == values.size() && at < shown_at_ + period_ &&
           std::memcmp(shown_.data(), values.data(), values.size_bytes()) == 0;
  }

  InspectionWriter<PubSub> writer_;
  std::size_t length_;
  Duration period_;
  std::vector<double> shown_;
  Time shown_at_{};
};

class ScanWriter final : public TypedWriter<sensor_msgs::msg::dds_::LaserScan_PubSubType> {
 public:
  ScanWriter(Participant& participant, const std::string& agent, const Channel& channel,
             std::atomic<int>& readers)
      : TypedWriter(participant, agent, channel, readers) {
    const std::vector<double>& headings = channel.headings;
    if (headings.empty()) return;
    const double step = headings.size() > 1 ? headings[1] - headings[0] : 0;
    sample().header().frame_id(agent + "/" + channel.frame);
    sample().angle_min(static_cast<float>(headings.front()));
    sample().angle_max(static_cast<float>(headings.back()));
    sample().angle_increment(static_cast<float>(step));
    sample().time_increment(0);  // all rays at once
    sample().scan_time(static_cast<float>(to_seconds(channel.period)));
    sample().range_min(static_cast<float>(channel.low));
    sample().range_max(static_cast<float>(channel.high));
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

class BumperWriter final : public TypedWriter<std_msgs::msg::dds_::Bool_PubSubType> {
 public:
  using TypedWriter::TypedWriter;

 private:
  void fill(Time, std::span<const double> values) override { sample().data(values[0] != 0); }
};

class ImuWriter final : public TypedWriter<sensor_msgs::msg::dds_::Imu_PubSubType> {
 public:
  ImuWriter(Participant& participant, const std::string& agent, const Channel& channel,
            std::atomic<int>& readers)
      : TypedWriter(participant, agent, channel, readers) {
    sample().header().frame_id(agent + "/" + channel.frame);
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

using Make = std::unique_ptr<ChannelWriter> (*)(Participant&, const std::string&, const Channel&,
                                                std::atomic<int>&);

template <class Writer>
std::unique_ptr<ChannelWriter> make(Participant& participant, const std::string& agent,
                                    const Channel& channel, std::atomic<int>& readers) {
  return std::make_unique<Writer>(participant, agent, channel, readers);
}

struct Kind {
  std::string_view name;
  Make make;
};

/// The one table from kinds of channels to types of ROS 2. Infrared and odometry, which are shown
/// unasked, have topics of their own in Inspector.
constexpr std::array kKinds{
    Kind{"pose", make<PoseWriter>},      // geometry_msgs/PoseStamped
    Kind{"bumper", make<BumperWriter>},  // std_msgs/Bool
    Kind{"imu", make<ImuWriter>},        // sensor_msgs/Imu
    Kind{"scan", make<ScanWriter>},      // sensor_msgs/LaserScan
};

}  // namespace

std::unique_ptr<ChannelWriter> make_channel_writer(Participant& participant,
                                                   const std::string& agent, const Channel& channel,
                                                   std::atomic<int>& readers) {
  const auto kind = std::ranges::find(kKinds, channel.kind, &Kind::name);
  if (kind == kKinds.end()) return nullptr;
  return kind->make(participant, agent, channel, readers);
}

}  // namespace hal::dds
