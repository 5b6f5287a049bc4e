#include "gateway/inspection/air_inspector.h"

#include <atomic>

#include "gateway/inspection/inspection_endpoints.h"
#include "idl/ros/values.h"
#include "inspectPubSubTypes.h"

namespace gateway::inspection {
namespace {

using idl::ros::to_ros;

/// Samples kept for a slow reader: enough for all topics, or kinds, of one instant.
constexpr int kAirSamples = 500;

}  // namespace

class AirInspector::Implementation {
 public:
  explicit Implementation(domain::Participant& participant)
      : topics(participant, "rt/baraka/air_topics", kAirSamples, readers),
        kinds(participant, "rt/baraka/air_kinds", kAirSamples, readers) {}

  std::atomic<int> readers{0};
  InspectionWriter<baraka_msgs::msg::dds_::AirTopic_PubSubType> topics;
  InspectionWriter<baraka_msgs::msg::dds_::AirKind_PubSubType> kinds;
};

AirInspector::AirInspector(InspectionParticipant& participant)
    : implementation_(std::make_unique<Implementation>(participant.participant())) {}

AirInspector::~AirInspector() = default;

int AirInspector::readers() const noexcept {
  return implementation_->readers.load(std::memory_order_relaxed);
}

void AirInspector::publish(hal::Time at, const TopicUse& use) {
  auto& writer = implementation_->topics;
  if (!writer.has_readers()) return;
  auto& sample = writer.sample();
  sample.stamp(to_ros(at));
  sample.topic(std::string(use.topic));
  sample.samples(use.samples);
  sample.delivered(use.delivered);
  sample.first_try(use.first_try);
  sample.repaired(use.delivered - use.first_try);
  sample.latency_median(to_ros(use.latency_median));
  sample.latency_p99(to_ros(use.latency_p99));
  sample.airtime(to_ros(use.airtime));
  sample.share(use.share);
  writer.write();
}

void AirInspector::publish(hal::Time at, const KindUse& use) {
  auto& writer = implementation_->kinds;
  if (!writer.has_readers()) return;
  auto& sample = writer.sample();
  sample.stamp(to_ros(at));
  sample.purpose(std::string(use.purpose));
  sample.kind(use.kind);
  sample.port(use.port);
  sample.frames(use.frames);
  sample.retries(use.retries);
  sample.submessages(use.submessages);
  sample.bits(use.bits);
  sample.airtime(to_ros(use.airtime));
  sample.share(use.share);
  writer.write();
}

}  // namespace gateway::inspection
