// Plays `topics:` on Cyclone DDS: real participants of a vendor, which know nothing of the
// simulator. The vendor's configuration is what CYCLONEDDS_URI names.
#include <dds/dds.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "programs/topics/player.h"
#include "sample.h"

namespace programs::topics {
namespace {

constexpr const char* kUnknown = "?";  ///< A participant without a name.

dds_entity_t checked(dds_entity_t entity, const std::string& what) {
  if (entity >= 0) return entity;
  throw std::runtime_error(what + " cannot be created: " + dds_strretcode(entity));
}

struct QosDeleter {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

/// Policies that the plan states; the others are the vendor's defaults.
Qos endpoint_qos(const hal::TopicQos& given) {
  using Kind = hal::TopicQos;
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(),
                       given.reliability == Kind::Reliability::kReliable
                           ? DDS_RELIABILITY_RELIABLE
                           : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_MSECS(100));  // the default of OMG DDS 1.4, 2.2.3
  const dds_history_kind_t history = given.depth ? DDS_HISTORY_KEEP_LAST : DDS_HISTORY_KEEP_ALL;
  const auto depth = static_cast<std::int32_t>(given.depth.value_or(1));
  dds_qset_history(qos.get(), history, given.depth ? depth : 0);
  if (given.durability == Kind::Durability::kTransientLocal) {
    dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    // What late readers get is this history in Cyclone, and by default the last sample only.
    dds_qset_durability_service(qos.get(), 0, history, depth, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  }
  if (given.deadline) dds_qset_deadline(qos.get(), given.deadline->count());
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

class CyclonePeer final : public Participant {
 public:
  CyclonePeer(const Plan& plan, Journal& journal) : journal_(journal) {
    const Qos qos(dds_create_qos());
    dds_qset_entity_name(qos.get(), plan.name.c_str());
    participant_ = checked(dds_create_participant(plan.domain, qos.get(), nullptr), "participant");
    participants_ = checked(
        dds_create_reader(participant_, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr),
        "reader of participants");
  }
  ~CyclonePeer() override { dds_delete(participant_); }
  CyclonePeer(const CyclonePeer&) = delete;
  CyclonePeer& operator=(const CyclonePeer&) = delete;

  void read(const ReadTopic& topic) override {
    readers_.push_back(std::make_unique<Reader>(Reader{*this, topic.name, {}}));
    dds_listener_t* const listener = dds_create_listener(readers_.back().get());
    dds_lset_data_available(listener, on_data);
    const dds_entity_t reader = dds_create_reader(participant_, topic_of(topic.name),
                                                  endpoint_qos(topic.qos).get(), listener);
    dds_delete_listener(listener);
    checked(reader, "reader of " + topic.name);
  }

  Write write(const WrittenTopic& topic, std::uint32_t most) override {
    const dds_entity_t writer = checked(dds_create_writer(participant_, topic_of(topic.name),
                                                          endpoint_qos(topic.qos).get(), nullptr),
                                        "writer of " + topic.name);
    const auto octets = std::make_shared<std::vector<std::uint8_t>>(most - kLeastSize + 1);
    return [writer, octets](std::uint32_t bytes) {
      topics_Sample sample;
      std::memset(&sample, 0, sizeof sample);
      sample.bytes._buffer = octets->data();
      sample.bytes._length = sample.bytes._maximum = bytes - kLeastSize;
      return dds_write(writer, &sample) == DDS_RETCODE_OK;
    };
  }

 private:
  struct Reader {
    CyclonePeer& peer;
    std::string topic;
    std::map<dds_instance_handle_t, std::string> writers;  ///< Participants, by their writers.
  };

  dds_entity_t topic_of(const std::string& name) {
    const auto [found, is_new] = topics_.try_emplace(name, 0);
    if (is_new) {
      found->second = checked(
          dds_create_topic(participant_, &topics_Sample_desc, name.c_str(), nullptr, nullptr),
          "topic " + name);
    }
    return found->second;
  }

  static void on_data(dds_entity_t reader, void* context) {
    auto& own = *static_cast<Reader*>(context);
    constexpr std::size_t kTaken = 16;
    void* samples[kTaken] = {};
    dds_sample_info_t infos[kTaken];
    while (true) {
      const std::int32_t count = dds_take(reader, samples, infos, kTaken, kTaken);
      if (count <= 0) return;
      for (std::int32_t i = 0; i < count; ++i) {
        if (infos[i].valid_data)
          own.peer.journal_.received(own.topic, own.peer.writer_of(own, reader, infos[i]),
                                     dds_time());
      }
      dds_return_loan(reader, samples, count);
    }
  }

  /// Name of the participant that wrote a sample.
  const std::string& writer_of(Reader& reader, dds_entity_t entity, const dds_sample_info_t& info) {
    const auto [found, is_new] = reader.writers.try_emplace(info.publication_handle, kUnknown);
    if (!is_new) return found->second;
    dds_builtintopic_endpoint_t* const writer =
        dds_get_matched_publication_data(entity, info.publication_handle);
    if (writer == nullptr) return found->second;
    found->second = name_of(writer->participant_instance_handle);
    dds_builtintopic_free_endpoint(writer);
    return found->second;
  }

  std::string name_of(dds_instance_handle_t participant) const {
    void* data = nullptr;
    dds_sample_info_t info;
    if (dds_read_instance(participants_, &data, &info, 1, 1, participant) != 1) return kUnknown;
    const auto& known = *static_cast<const dds_builtintopic_participant_t*>(data);
    std::string result = kUnknown;
    char* name = nullptr;
    if (info.valid_data && dds_qget_entity_name(known.qos, &name) && name != nullptr) {
      result = name;
      dds_free(name);
    }
    dds_return_loan(participants_, &data, 1);
    return result;
  }

  Journal& journal_;
  dds_entity_t participant_ = 0;
  dds_entity_t participants_ = 0;  ///< Reader of all that were discovered.
  std::map<std::string, dds_entity_t> topics_;
  std::vector<std::unique_ptr<Reader>> readers_;
};

}  // namespace
}  // namespace programs::topics

int main(int argc, char** argv) {
  using namespace programs::topics;
  return play(argc, argv, [](const Plan& plan, Journal& journal) -> std::unique_ptr<Participant> {
    return std::make_unique<CyclonePeer>(plan, journal);
  });
}
