#include "gateway/inspection/inspection_endpoints.h"

namespace gateway::inspection {
namespace {

/// Heartbeat period: how often a reader that lacks samples is told so.
constexpr hal::Duration kInspectionHeartbeat = std::chrono::milliseconds{100};
constexpr int kReaderDepth = 100;

template <class Qos>
void set_inspection_qos(Qos& qos, guard::api::ReliabilityQosPolicyKind reliability, Keep keep,
                        int depth) {
  qos.reliability().kind = reliability;
  qos.reliability().max_blocking_time = guard::to_dds(std::chrono::milliseconds{1});
  qos.durability().kind = keep == Keep::kForLatecomers ? guard::api::TRANSIENT_LOCAL_DURABILITY_QOS
                                                       : guard::api::VOLATILE_DURABILITY_QOS;
  qos.history().kind = guard::api::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = depth;
  qos.resource_limits().max_instances = 1;
  qos.resource_limits().max_samples_per_instance = depth;
  qos.resource_limits().max_samples = depth;
  qos.resource_limits().allocated_samples = 1;
  qos.endpoint().history_memory_policy = guard::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
}

}  // namespace

guard::api::DataWriterQos inspection_writer_qos(int depth, Keep keep) {
  guard::api::DataWriterQos qos = guard::api::DATAWRITER_QOS_DEFAULT;
  set_inspection_qos(qos, guard::api::RELIABLE_RELIABILITY_QOS, keep, depth);
  qos.publish_mode().kind = guard::api::SYNCHRONOUS_PUBLISH_MODE;
  qos.reliable_writer_qos().times.heartbeatPeriod = guard::to_dds(kInspectionHeartbeat);
  return qos;
}

guard::api::DataReaderQos inspection_reader_qos(guard::api::ReliabilityQosPolicyKind reliability,
                                                Keep keep) {
  guard::api::DataReaderQos qos = guard::api::DATAREADER_QOS_DEFAULT;
  set_inspection_qos(qos, reliability, keep, kReaderDepth);
  return qos;
}

}  // namespace gateway::inspection
