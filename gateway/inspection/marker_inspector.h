#pragma once

#include <memory>

#include "gateway/inspection/inspection_participant.h"
#include "hal/types/geometry.h"
#include "hal/types/solid.h"
#include "hal/types/time.h"

namespace gateway::inspection {

/// Publishes bodies and walls for RViz and similar tools:
///
/// topic       type                            what
/// rt/markers  visualization_msgs/MarkerArray  a marker per solid, in the frame "world"; its
///                                             namespace is the agent's name or "walls/<name>", its
///                                             id the number of the solid
///
/// A marker stays until it is sent again. The last samples are kept for readers that join later.
/// Like Inspector, it never waits for a reader. One thread at a time, except readers(): any thread.
class MarkerInspector {
 public:
  /// @throws std::runtime_error  if DDS makes no writer.
  explicit MarkerInspector(InspectionParticipant& participant);
  ~MarkerInspector();
  MarkerInspector(const MarkerInspector&) = delete;
  MarkerInspector& operator=(const MarkerInspector&) = delete;

  int readers() const noexcept;

  /// Adds a body to the next sample. @param pose  of the body's frame in the world; for a wall: {}
  void add(hal::Time at, const hal::DrawnBody& body, const hal::Pose2& pose);

  /// Writes a sample with the added bodies, if there are any.
  void publish();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gateway::inspection
