// Plays `topics:` on Fast DDS: real participants of a vendor, which know nothing of the simulator.
// The vendor's configuration is what FASTRTPS_DEFAULT_PROFILES_FILE names: the default profiles of
// participant, writer and reader.
#include <algorithm>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "programs/topics/player.h"

namespace programs::topics {
namespace {

namespace fdds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using eprosima::fastrtps::types::ReturnCode_t;

/// A sample of sample.idl: only its length counts.
struct Octets {
  std::uint32_t serialised = kLeastSize;
};

/// sample.idl in XCDR version 1, as Cyclone writes it (OMG DDS-XTypes 1.3, 7.4).
class SampleType final : public fdds::TopicDataType {
 public:
  SampleType() {
    setName("topics::Sample");
    m_typeSize = kLeastSize;  // of a first buffer, which grows
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }

  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const std::uint32_t size = static_cast<const Octets*>(data)->serialised;
    if (payload->max_size < size) return false;
    const std::uint32_t length = size - kLeastSize;
    constexpr std::array<rtps::octet, 4> kLittleEndian{0, 1, 0, 0};
    payload->encapsulation = CDR_LE;
    payload->length = size;
    std::memset(payload->data, 0, size);
    std::memcpy(payload->data, kLittleEndian.data(), kLittleEndian.size());
    for (std::uint32_t i = 0; i < 4; ++i)
      payload->data[4 + i] = static_cast<rtps::octet>(length >> (8 * i) & 0xff);
    return true;
  }

  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    static_cast<Octets*>(data)->serialised = payload->length;
    return true;
  }

  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<const Octets*>(data)->serialised; };
  }
  void* createData() override { return new Octets; }
  void deleteData(void* data) override { delete static_cast<Octets*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

template <class T>
T* checked(T* entity, const std::string& what) {
  if (entity != nullptr) return entity;
  throw std::runtime_error(what + " cannot be created");
}

/// Policies that the plan states; the others are the vendor's defaults or the profile's.
template <class Qos>
void apply(const hal::TopicQos& given, Qos& qos) {
  using Kind = hal::TopicQos;
  qos.reliability().kind = given.reliability == Kind::Reliability::kReliable
                               ? fdds::RELIABLE_RELIABILITY_QOS
                               : fdds::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind = given.durability == Kind::Durability::kTransientLocal
                              ? fdds::TRANSIENT_LOCAL_DURABILITY_QOS
                              : fdds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = given.depth ? fdds::KEEP_LAST_HISTORY_QOS : fdds::KEEP_ALL_HISTORY_QOS;
  if (given.depth) {
    qos.history().depth = static_cast<std::int32_t>(*given.depth);
    auto& limits = qos.resource_limits();  // must have room for the history
    limits.max_samples_per_instance =
        std::max(limits.max_samples_per_instance, qos.history().depth);
    limits.max_samples =
        std::max(limits.max_samples, limits.max_instances * limits.max_samples_per_instance);
  }
  if (given.deadline) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    const std::int64_t deadline = given.deadline->count();
    qos.deadline().period =
        eprosima::fastrtps::Duration_t(static_cast<std::int32_t>(deadline / kSecond),
                                       static_cast<std::uint32_t>(deadline % kSecond));
  }
  qos.endpoint().history_memory_policy =
      rtps::MemoryManagementPolicy_t::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
}

/// The names of the participants that were discovered.
class Names final : public fdds::DomainParticipantListener {
 public:
  std::string of(const rtps::GuidPrefix_t& participant) {
    const std::lock_guard lock(mutex_);
    const auto found = names_.find(participant);
    return found == names_.end() ? "?" : found->second;
  }

 private:
  void on_participant_discovery(fdds::DomainParticipant*,
                                rtps::ParticipantDiscoveryInfo&& info) override {
    const std::lock_guard lock(mutex_);
    names_[info.info.m_guid.guidPrefix] = info.info.m_participantName.to_string();
  }

  std::mutex mutex_;
  std::map<rtps::GuidPrefix_t, std::string> names_;
};

std::int64_t real_time() {
  timespec time{};
  clock_gettime(CLOCK_REALTIME, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

class Receiver final : public fdds::DataReaderListener {
 public:
  Receiver(std::string topic, Journal& journal, Names& names)
      : topic_(std::move(topic)), journal_(journal), names_(names) {}

 private:
  /// Fast DDS 2.9 cannot ignore the endpoints of the own participant: they are not counted.
  void on_data_available(fdds::DataReader* reader) override {
    Octets sample;
    fdds::SampleInfo info;
    while (reader->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK) {
      const auto writer = rtps::iHandle2GUID(info.publication_handle).guidPrefix;
      if (info.valid_data && writer != reader->guid().guidPrefix)
        journal_.received(topic_, names_.of(writer), real_time());
    }
  }

  std::string topic_;
  Journal& journal_;
  Names& names_;
};

class FastPeer final : public Participant {
 public:
  FastPeer(const Plan& plan, Journal& journal) : journal_(journal) {
    auto* const factory = fdds::DomainParticipantFactory::get_instance();
    factory->load_profiles();
    fdds::DomainParticipantQos qos;
    factory->get_default_participant_qos(qos);
    qos.name(plan.name);
    participant_ =
        checked(factory->create_participant(plan.domain, qos, &names_, fdds::StatusMask::none()),
                "participant");
    type_.register_type(participant_);
    publisher_ = checked(participant_->create_publisher(fdds::PUBLISHER_QOS_DEFAULT), "publisher");
    subscriber_ =
        checked(participant_->create_subscriber(fdds::SUBSCRIBER_QOS_DEFAULT), "subscriber");
  }
  ~FastPeer() override {
    participant_->delete_contained_entities();
    fdds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  FastPeer(const FastPeer&) = delete;
  FastPeer& operator=(const FastPeer&) = delete;

  void read(const ReadTopic& topic) override {
    fdds::DataReaderQos qos = subscriber_->get_default_datareader_qos();
    apply(topic.qos, qos);
    receivers_.push_back(std::make_unique<Receiver>(topic.name, journal_, names_));
    checked(subscriber_->create_datareader(topic_of(topic.name), qos, receivers_.back().get()),
            "reader of " + topic.name);
  }

  Write write(const WrittenTopic& topic, std::uint32_t /*most*/) override {
    fdds::DataWriterQos qos = publisher_->get_default_datawriter_qos();
    apply(topic.qos, qos);
    fdds::DataWriter* const writer = checked(
        publisher_->create_datawriter(topic_of(topic.name), qos), "writer of " + topic.name);
    return [writer](std::uint32_t bytes) {
      Octets sample{bytes};
      return writer->write(&sample);
    };
  }

 private:
  fdds::Topic* topic_of(const std::string& name) {
    const auto [found, is_new] = topics_.try_emplace(name, nullptr);
    if (is_new) {
      found->second =
          checked(participant_->create_topic(name, type_.get_type_name(), fdds::TOPIC_QOS_DEFAULT),
                  "topic " + name);
    }
    return found->second;
  }

  Journal& journal_;
  Names names_;
  fdds::TypeSupport type_{new SampleType};
  fdds::DomainParticipant* participant_ = nullptr;
  fdds::Publisher* publisher_ = nullptr;
  fdds::Subscriber* subscriber_ = nullptr;
  std::map<std::string, fdds::Topic*> topics_;
  std::vector<std::unique_ptr<Receiver>> receivers_;
};

}  // namespace
}  // namespace programs::topics

int main(int argc, char** argv) {
  using namespace programs::topics;
  return play(argc, argv, [](const Plan& plan, Journal& journal) -> std::unique_ptr<Participant> {
    return std::make_unique<FastPeer>(plan, journal);
  });
}
