#include "hal/dds/inspection/twist_reader.h"

#include <atomic>
#include <cmath>
#include <mutex>

#include "hal/dds/inspection/inspection_endpoints.h"
#include "inspectPubSubTypes.h"

namespace hal::dds {
namespace {

using geometry_msgs::msg::dds_::Twist_;
using geometry_msgs::msg::dds_::Twist_PubSubType;
using geometry_msgs::msg::dds_::Vector3_;

bool is_finite(const Vector3_& v) {
  return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

}  // namespace

class TwistReader::Implementation {
 public:
  Implementation(InspectionParticipant& inspection, const std::string& agent,
                 std::function<void(const Command&)> on_command)
      : on_command_(std::move(on_command)),
        topic_(inspection.participant(), "rt/" + agent + "/cmd_vel"),
        reader_(inspection.participant(), topic_.get(),
                inspection_reader_qos(api::BEST_EFFORT_RELIABILITY_QOS, Keep::kForThoseHere),
                [this](const Twist_& sample, const api::SampleInfo&) { on_sample(sample); }) {}

  std::optional<Command> last() const {
    const std::lock_guard lock(mutex_);
    return last_;
  }
  std::uint64_t dropped() const { return dropped_; }
  int writers() const { return reader_.writers(); }

 private:
  void on_sample(const Twist_& sample) {
    if (!is_finite(sample.linear()) || !is_finite(sample.angular())) {
      ++dropped_;
      return;
    }
    Command command;
    {
      const std::lock_guard lock(mutex_);
      command = {.twist = {sample.linear().x(), sample.linear().y(), sample.angular().z()},
                 .number = last_ ? last_->number + 1 : 1};
      last_ = command;
    }
    if (on_command_) on_command_(command);
  }

  std::function<void(const Command&)> on_command_;
  mutable std::mutex mutex_;
  std::optional<Command> last_;
  std::atomic<std::uint64_t> dropped_{0};
  OwnTopic<Twist_PubSubType> topic_;
  InspectionReader<Twist_PubSubType> reader_;
};

TwistReader::TwistReader(InspectionParticipant& participant, const std::string& agent,
                         std::function<void(const Command&)> on_command)
    : implementation_(std::make_unique<Implementation>(participant, agent, std::move(on_command))) {
}
TwistReader::~TwistReader() = default;

std::optional<TwistReader::Command> TwistReader::last() const { return implementation_->last(); }
std::uint64_t TwistReader::dropped() const { return implementation_->dropped(); }
int TwistReader::writers() const { return implementation_->writers(); }

}  // namespace hal::dds
