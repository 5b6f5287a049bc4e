#include "hal/dds/emergency_stop_reader.h"

#include <atomic>

#include "hal/dds/inspection_endpoints.h"
#include "inspectPubSubTypes.h"

namespace hal::dds {

using std_msgs::msg::dds_::Bool_;
using std_msgs::msg::dds_::Bool_PubSubType;

class EmergencyStopReader::Implementation {
 public:
  Implementation(InspectionParticipant& inspection, const std::string& agent,
                 std::function<void(bool)> on_change)
      : on_change_(std::move(on_change)),
        topic_(inspection.participant(), "rt/" + agent + "/emergency_stop"),
        // A reader that asks for kept samples does not match writers that keep none.
        live_(inspection.participant(), topic_.get(), qos(Keep::kForThoseHere),
              [this](const Bool_& sample) { on_sample(sample.data()); }),
        kept_(inspection.participant(), topic_.get(), qos(Keep::kForLatecomers),
              [this](const Bool_& sample) { on_sample(sample.data()); }) {}

  bool is_stopped() const { return is_stopped_; }
  int writers() const { return live_.writers(); }

 private:
  static api::DataReaderQos qos(Keep keep) {
    return inspection_reader_qos(api::RELIABLE_RELIABILITY_QOS, keep);
  }
  void on_sample(bool stop) {
    is_stopped_ = stop;
    if (on_change_) on_change_(stop);
  }

  std::function<void(bool)> on_change_;
  std::atomic<bool> is_stopped_{false};
  OwnTopic<Bool_PubSubType> topic_;
  InspectionReader<Bool_PubSubType> live_, kept_;
};

EmergencyStopReader::EmergencyStopReader(InspectionParticipant& participant,
                                         const std::string& agent,
                                         std::function<void(bool stop)> on_change)
    : implementation_(std::make_unique<Implementation>(participant, agent, std::move(on_change))) {}
EmergencyStopReader::~EmergencyStopReader() = default;

bool EmergencyStopReader::is_stopped() const { return implementation_->is_stopped(); }
int EmergencyStopReader::writers() const { return implementation_->writers(); }

}  // namespace hal::dds
