#include "gateway/inspection/twist_reader.h"

#include <cmath>

#include "gateway/inspection/inspection_endpoints.h"
#include "inspectPubSubTypes.h"

namespace gateway::inspection {
namespace {

using geometry_msgs::msg::dds_::Twist_;
using geometry_msgs::msg::dds_::Twist_PubSubType;
using geometry_msgs::msg::dds_::Vector3_;

bool is_finite(const Vector3_& v) {
  return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

std::optional<TwistReader::Command> read_twist(const Twist_& sample,
                                               const std::optional<TwistReader::Command>& before) {
  if (!is_finite(sample.linear()) || !is_finite(sample.angular())) return std::nullopt;
  return TwistReader::Command{
      .twist = {sample.linear().x(), sample.linear().y(), sample.angular().z()},
      .number = before ? before->number + 1 : 1};
}

}  // namespace

class TwistReader::Implementation : public LatestSample<Twist_PubSubType, Command> {
 public:
  using LatestSample::LatestSample;
};

TwistReader::TwistReader(InspectionParticipant& participant, const std::string& agent,
                         std::function<void(const Command&)> on_command)
    : implementation_(std::make_unique<Implementation>(participant.participant(),
                                                       "rt/" + agent + "/cmd_vel", read_twist,
                                                       std::move(on_command))) {}
TwistReader::~TwistReader() = default;

std::optional<TwistReader::Command> TwistReader::last() const { return implementation_->last(); }
std::uint64_t TwistReader::dropped() const { return implementation_->dropped(); }
int TwistReader::writers() const { return implementation_->writers(); }

}  // namespace gateway::inspection
