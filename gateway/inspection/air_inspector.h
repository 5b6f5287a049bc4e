#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "gateway/inspection/inspection_participant.h"
#include "hal/types/time.h"

namespace gateway::inspection {

/// Publishes the use of the air in a run whose programs communicate through sockets:
///
/// topic                 type                  what
/// rt/baraka/air_topics  baraka_msgs/AirTopic  one sample per topic of programs
/// rt/baraka/air_kinds   baraka_msgs/AirKind   one sample per kind of submessage, protocol, frame
///
/// Like Inspector, it writes nothing while a topic has no reader. One thread at a time, except
/// has_readers(): any thread.
class AirInspector {
 public:
  /// Totals since the start of the run; fields as in the message baraka_msgs/AirTopic.
  struct TopicUse {
    std::string_view topic;
    std::uint64_t samples = 0, delivered = 0, first_try = 0;
    hal::Duration latency_median{}, latency_p99{};
    hal::Duration airtime{};
    double share = 0;
  };
  struct KindUse {
    std::string_view purpose;
    std::string kind;
    std::uint16_t port = 0;
    std::uint64_t frames = 0, retries = 0, submessages = 0, bits = 0;
    hal::Duration airtime{};
    double share = 0;
  };

  /// @throws std::runtime_error  if DDS makes no writer.
  explicit AirInspector(InspectionParticipant& participant);
  ~AirInspector();
  AirInspector(const AirInspector&) = delete;
  AirInspector& operator=(const AirInspector&) = delete;

  bool has_readers() const noexcept { return readers() > 0; }
  int readers() const noexcept;  ///< Number of readers of both topics together.
  void publish(hal::Time at, const TopicUse& use);
  void publish(hal::Time at, const KindUse& use);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gateway::inspection
