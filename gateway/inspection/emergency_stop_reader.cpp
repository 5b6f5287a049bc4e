#include "gateway/inspection/emergency_stop_reader.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>

#include "gateway/inspection/inspection_endpoints.h"
#include "inspectPubSubTypes.h"

namespace gateway::inspection {

using std_msgs::msg::dds_::Bool_;
using std_msgs::msg::dds_::Bool_PubSubType;

class EmergencyStopReader::Implementation {
 public:
  Implementation(InspectionParticipant& inspection, const std::string& agent,
                 std::function<void(bool)> on_change)
      : on_change_(std::move(on_change)),
        topic_(inspection.participant(), "rt/" + agent + "/emergency_stop"),
        // Two readers, because one that requests kept samples does not match writers that keep
        // none.
        live_(inspection.participant(), topic_.get(), qos(Keep::kForThoseHere), sample(), left()),
        kept_(inspection.participant(), topic_.get(), qos(Keep::kForLatecomers), sample(), left()) {
  }

  bool is_stopped() const { return is_stopped_; }
  int writers() const { return live_.writers(); }
  void release() {
    const std::lock_guard lock(mutex_);
    for (auto& [handle, writer] : writers_) writer.stops = false;
    tell();
  }

 private:
  struct Writer {
    std::uint64_t last = 0;  ///< Sequence number of the writer's last sample.
    bool stops = false;      ///< That sample was `true`, and the stop has not been released.
    bool is_here = true;
  };

  static guard::api::DataReaderQos qos(Keep keep) {
    return inspection_reader_qos(guard::api::RELIABLE_RELIABILITY_QOS, keep);
  }
  InspectionReader<Bool_PubSubType>::OnSample sample() {
    return [this](const Bool_& sample, const guard::api::SampleInfo& info) {
      on_sample(sample.data(), info);
    };
  }
  InspectionReader<Bool_PubSubType>::OnLeft left() {
    return [this](const guard::api::InstanceHandle_t& handle) {
      const std::lock_guard lock(mutex_);
      const auto known = writers_.find(handle);
      if (known != writers_.end()) known->second.is_here = false;
    };
  }

  void on_sample(bool stops, const guard::api::SampleInfo& info) {
    const std::lock_guard lock(mutex_);
    Writer& writer = writers_[info.publication_handle];
    const std::uint64_t number = info.sample_identity.sequence_number().to64long();
    if (number <= writer.last) return;  // The other reader delivered this sample or a later one.
    writer = {number, stops, true};
    if (!stops) std::erase_if(writers_, [](const auto& entry) { return !entry.second.is_here; });
    tell();
  }
  void tell() {
    is_stopped_ =
        std::ranges::any_of(writers_, [](const auto& entry) { return entry.second.stops; });
    if (on_change_) on_change_(is_stopped_);
  }

  std::function<void(bool)> on_change_;
  std::atomic<bool> is_stopped_{false};
  std::mutex mutex_;
  std::map<guard::api::InstanceHandle_t, Writer> writers_;
  OwnTopic<Bool_PubSubType> topic_;
  InspectionReader<Bool_PubSubType> live_, kept_;
};

EmergencyStopReader::EmergencyStopReader(InspectionParticipant& participant,
                                         const std::string& agent,
                                         std::function<void(bool stop)> on_change)
    : implementation_(std::make_unique<Implementation>(participant, agent, std::move(on_change))) {}
EmergencyStopReader::~EmergencyStopReader() = default;

bool EmergencyStopReader::is_stopped() const { return implementation_->is_stopped(); }
void EmergencyStopReader::release() { implementation_->release(); }
int EmergencyStopReader::writers() const { return implementation_->writers(); }

}  // namespace gateway::inspection
