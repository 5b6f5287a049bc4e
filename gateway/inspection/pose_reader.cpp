#include "gateway/inspection/pose_reader.h"

#include <cmath>

#include "gateway/inspection/inspection_endpoints.h"
#include "idl/ros/values.h"
#include "inspectPubSubTypes.h"

namespace gateway::inspection {
namespace {

using geometry_msgs::msg::dds_::PoseStamped_;
using geometry_msgs::msg::dds_::PoseStamped_PubSubType;
using geometry_msgs::msg::dds_::Quaternion_;

/// Largest deviation of an orientation's norm from 1: some senders round to single precision.
constexpr double kNormTolerance = 1e-3;

/// The DDS name of a ROS 2 topic: "rt/a/b" for "/a/b" and "a/b".
std::string dds_name(const std::string& topic) {
  if (topic.starts_with("rt/")) return topic;
  return (topic.starts_with("/") ? "rt" : "rt/") + topic;
}

double norm(const Quaternion_& q) {
  return std::sqrt(q.x() * q.x() + q.y() * q.y() + q.z() * q.z() + q.w() * q.w());
}

std::optional<OutsidePose> read_pose(const PoseStamped_& sample,
                                     const std::optional<OutsidePose>&) {
  const auto& position = sample.pose().position();
  // If the norm is NaN, the comparison is false.
  const bool is_good = std::isfinite(position.x()) && std::isfinite(position.y()) &&
                       std::abs(norm(sample.pose().orientation()) - 1) <= kNormTolerance;
  if (!is_good) return std::nullopt;
  const auto& stamp = sample.header().stamp();
  return OutsidePose{
      .pose = {position.x(), position.y(), idl::ros::heading_of(sample.pose().orientation())},
      .frame = sample.header().frame_id(),
      .sender_time_ns = std::int64_t{stamp.sec()} * 1'000'000'000 + stamp.nanosec()};
}

}  // namespace

class PoseReader::Implementation : public LatestSample<PoseStamped_PubSubType, OutsidePose> {
 public:
  using LatestSample::LatestSample;
};

PoseReader::PoseReader(InspectionParticipant& participant, const std::string& topic,
                       std::function<void(const OutsidePose&)> on_pose)
    : implementation_(std::make_unique<Implementation>(participant.participant(), dds_name(topic),
                                                       read_pose, std::move(on_pose))) {}
PoseReader::~PoseReader() = default;

std::optional<OutsidePose> PoseReader::last() const { return implementation_->last(); }
std::uint64_t PoseReader::dropped() const { return implementation_->dropped(); }
int PoseReader::writers() const { return implementation_->writers(); }

}  // namespace gateway::inspection
