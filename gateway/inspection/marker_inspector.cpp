#include "gateway/inspection/marker_inspector.h"

#include <atomic>

#include "gateway/inspection/inspection_endpoints.h"
#include "idl/ros/markers.h"
#include "inspectPubSubTypes.h"

namespace gateway::inspection {
namespace {

constexpr int kMarkerSamples = 10;

}  // namespace

class MarkerInspector::Implementation {
 public:
  explicit Implementation(domain::Participant& participant)
      : writer(participant, "rt/markers", kMarkerSamples, readers, Keep::kForLatecomers) {}

  std::atomic<int> readers{0};
  InspectionWriter<visualization_msgs::msg::dds_::MarkerArray_PubSubType> writer;
};

MarkerInspector::MarkerInspector(InspectionParticipant& participant)
    : implementation_(std::make_unique<Implementation>(participant.participant())) {}

MarkerInspector::~MarkerInspector() = default;

int MarkerInspector::readers() const noexcept {
  return implementation_->readers.load(std::memory_order_relaxed);
}

void MarkerInspector::add(hal::Time at, const hal::DrawnBody& body, const hal::Pose2& pose) {
  const std::string prefix = body.kind == hal::DrawnAs::kWall ? "walls/" : "";
  idl::ros::add_markers(implementation_->writer.sample().markers(), at, prefix + body.name,
                        {body, pose});
}

void MarkerInspector::publish() {
  auto& writer = implementation_->writer;
  if (writer.sample().markers().empty()) return;
  writer.write();
  writer.sample().markers().clear();
}

}  // namespace gateway::inspection
