#include "hal/dds/inspection/pose_reader.h"

#include <atomic>
#include <cmath>
#include <mutex>

#include "hal/dds/inspection/inspection_endpoints.h"
#include "hal/dds/inspection/inspection_values.h"
#include "inspectPubSubTypes.h"

namespace hal::dds {
namespace {

using geometry_msgs::msg::dds_::PoseStamped_;
using geometry_msgs::msg::dds_::PoseStamped_PubSubType;
using geometry_msgs::msg::dds_::Quaternion_;

/// How far from 1 the norm of an orientation may be: some senders round to single precision.
constexpr double kNormTolerance = 1e-3;

/// "/a/b" and "a/b" to "rt/a/b": the topic names of ROS 2 in DDS.
std::string dds_name(const std::string& topic) {
  if (topic.starts_with("rt/")) return topic;
  return (topic.starts_with("/") ? "rt" : "rt/") + topic;
}

double norm(const Quaternion_& q) {
  return std::sqrt(q.x() * q.x() + q.y() * q.y() + q.z() * q.z() + q.w() * q.w());
}

bool is_good(const PoseStamped_& sample) {
  const auto& position = sample.pose().position();
  // A comparison with what is not a number is false.
  return std::isfinite(position.x()) && std::isfinite(position.y()) &&
         std::abs(norm(sample.pose().orientation()) - 1) <= kNormTolerance;
}

OutsidePose from_ros(const PoseStamped_& sample) {
  const auto& position = sample.pose().position();
  const auto& stamp = sample.header().stamp();
  return {.pose = {position.x(), position.y(), heading_of(sample.pose().orientation())},
          .frame = sample.header().frame_id(),
          .sender_time_ns = std::int64_t{stamp.sec()} * 1'000'000'000 + stamp.nanosec()};
}

}  // namespace

class PoseReader::Implementation {
 public:
  Implementation(InspectionParticipant& inspection, const std::string& topic,
                 std::function<void(const OutsidePose&)> on_pose)
      : on_pose_(std::move(on_pose)),
        topic_(inspection.participant(), dds_name(topic)),
        reader_(inspection.participant(), topic_.get(),
                inspection_reader_qos(api::BEST_EFFORT_RELIABILITY_QOS, Keep::kForThoseHere),
                [this](const PoseStamped_& sample, const api::SampleInfo&) { on_sample(sample); }) {
  }

  std::optional<OutsidePose> last() const {
    const std::lock_guard lock(mutex_);
    return last_;
  }
  std::uint64_t dropped() const { return dropped_; }
  int writers() const { return reader_.writers(); }

 private:
  void on_sample(const PoseStamped_& sample) {
    if (!is_good(sample)) {
      ++dropped_;
      return;
    }
    const OutsidePose pose = from_ros(sample);
    {
      const std::lock_guard lock(mutex_);
      last_ = pose;
    }
    if (on_pose_) on_pose_(pose);
  }

  std::function<void(const OutsidePose&)> on_pose_;
  mutable std::mutex mutex_;
  std::optional<OutsidePose> last_;
  std::atomic<std::uint64_t> dropped_{0};
  OwnTopic<PoseStamped_PubSubType> topic_;
  InspectionReader<PoseStamped_PubSubType> reader_;
};

PoseReader::PoseReader(InspectionParticipant& participant, const std::string& topic,
                       std::function<void(const OutsidePose&)> on_pose)
    : implementation_(std::make_unique<Implementation>(participant, topic, std::move(on_pose))) {}
PoseReader::~PoseReader() = default;

std::optional<OutsidePose> PoseReader::last() const { return implementation_->last(); }
std::uint64_t PoseReader::dropped() const { return implementation_->dropped(); }
int PoseReader::writers() const { return implementation_->writers(); }

}  // namespace hal::dds
