#include "hal/dds/inspection/marker_inspector.h"

#include <atomic>

#include "hal/dds/inspection/inspection_endpoints.h"
#include "hal/dds/inspection/inspection_values.h"
#include "inspectPubSubTypes.h"

namespace hal::dds {
namespace {

using visualization_msgs::msg::dds_::Marker_;

constexpr int kMarkerSamples = 10;

std_msgs::msg::dds_::ColorRGBA_ opaque(const Colour& colour) {
  std_msgs::msg::dds_::ColorRGBA_ ros;
  ros.r(colour.red);
  ros.g(colour.green);
  ros.b(colour.blue);
  ros.a(1);
  return ros;
}

Marker_ marker_of(const Solid& solid, const Pose2& pose) {
  const Vec3 centre = centre_in_world(solid, pose);
  Marker_ marker;
  marker.header().frame_id("world");
  marker.type(static_cast<std::int32_t>(solid.shape));
  marker.pose().position().x(centre.x);
  marker.pose().position().y(centre.y);
  marker.pose().position().z(centre.z);
  marker.pose().orientation(to_quaternion(pose.theta + solid.yaw));
  marker.scale().x(solid.size.x);
  marker.scale().y(solid.size.y);
  marker.scale().z(solid.size.z);
  return marker;
}

}  // namespace

class MarkerInspector::Implementation {
 public:
  explicit Implementation(Participant& participant)
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

void MarkerInspector::add(Time at, const DrawnBody& body, const Pose2& pose) {
  auto& markers = implementation_->writer.sample().markers();
  const std::string prefix = body.kind == DrawnAs::kWall ? "walls/" : "";
  for (const Solid& solid : body.solids) {
    Marker_ marker = marker_of(solid, pose);
    marker.header().stamp(to_ros(at));
    marker.ns(prefix + body.name);
    marker.id(static_cast<std::int32_t>(&solid - body.solids.data()));
    marker.color(opaque(colour_of(body.kind)));
    markers.push_back(std::move(marker));
  }
}

void MarkerInspector::publish() {
  auto& writer = implementation_->writer;
  if (writer.sample().markers().empty()) return;
  writer.write();
  writer.sample().markers().clear();
}

}  // namespace hal::dds
