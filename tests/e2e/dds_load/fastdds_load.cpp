// A load on Fast DDS (options.c says how), which knows nothing of this project. Its configuration
// is what FASTRTPS_DEFAULT_PROFILES_FILE names: the default profiles of participant, writer and
// reader.
#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "journal.h"
#include "samplePubSubTypes.h"

namespace fdds = eprosima::fastdds::dds;
using eprosima::fastrtps::types::ReturnCode_t;

namespace {

template <class T>
T* checked(T* entity, const char* what) {
  if (entity != nullptr) return entity;
  std::fprintf(stderr, "fastdds_load: %s: cannot be created\n", what);
  std::exit(1);
}

/// Fast DDS 2.9 cannot ignore the endpoints of the own participant: they are not counted.
template <class Endpoint>
bool is_remote(const Endpoint& own, const eprosima::fastrtps::rtps::InstanceHandle_t& other) {
  return eprosima::fastrtps::rtps::iHandle2GUID(other).guidPrefix != own.guid().guidPrefix;
}

class WriterListener : public fdds::DataWriterListener {
  void on_publication_matched(fdds::DataWriter* writer,
                              const fdds::PublicationMatchedStatus& status) override {
    if (is_remote(*writer, status.last_subscription_handle))
      note_matched(true, status.current_count_change);
  }
};

class ReaderListener : public fdds::DataReaderListener {
  void on_subscription_matched(fdds::DataReader* reader,
                               const fdds::SubscriptionMatchedStatus& status) override {
    if (is_remote(*reader, status.last_publication_handle))
      note_matched(false, status.current_count_change);
  }

  void on_data_available(fdds::DataReader* reader) override {
    load::Sample sample;
    fdds::SampleInfo info;
    while (reader->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK)
      if (info.valid_data && is_remote(*reader, info.publication_handle))
        note_receive(sample.writer(), sample.number(), static_cast<uint32_t>(sample.bytes().size()),
                     sample.written_ns());
  }
};

fdds::DomainParticipant* create_participant(const Options& options) {
  auto* factory = fdds::DomainParticipantFactory::get_instance();
  factory->load_profiles();
  fdds::DomainParticipantQos qos;
  factory->get_default_participant_qos(qos);
  return checked(factory->create_participant(options.domain, qos), "participant");
}

template <class Qos>
void apply(const Options& options, Qos& qos) {
  if (options.reliability != kAsConfigured)
    qos.reliability().kind = options.reliability == kReliable ? fdds::RELIABLE_RELIABILITY_QOS
                                                              : fdds::BEST_EFFORT_RELIABILITY_QOS;
  if (options.blocking > 0)
    qos.reliability().max_blocking_time = eprosima::fastrtps::Duration_t(options.blocking);
  if (options.keep_all) qos.history().kind = fdds::KEEP_ALL_HISTORY_QOS;
  if (options.keep_last > 0) {
    qos.history().kind = fdds::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = static_cast<int32_t>(options.keep_last);
  }
  // Samples of any length: the type's bound is not known.
  qos.endpoint().history_memory_policy =
      eprosima::fastrtps::rtps::MemoryManagementPolicy_t::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
}

/// One topic may be both written and read.
fdds::Topic* topic_of(fdds::DomainParticipant& participant, const char* name,
                      const std::string& type) {
  if (auto* known = dynamic_cast<fdds::Topic*>(participant.lookup_topicdescription(name));
      known != nullptr)
    return known;
  return checked(participant.create_topic(name, type, fdds::TOPIC_QOS_DEFAULT), "topic");
}

void start_subscriber(const Options& options, fdds::DomainParticipant& participant,
                      const std::string& type, ReaderListener& listener) {
  auto* subscriber =
      checked(participant.create_subscriber(fdds::SUBSCRIBER_QOS_DEFAULT), "subscriber");
  fdds::DataReaderQos qos = subscriber->get_default_datareader_qos();
  apply(options, qos);
  checked(
      subscriber->create_datareader(topic_of(participant, options.subscribe, type), qos, &listener),
      "reader");
}

fdds::DataWriter* start_publisher(const Options& options, fdds::DomainParticipant& participant,
                                  const std::string& type, WriterListener& listener) {
  auto* publisher = checked(participant.create_publisher(fdds::PUBLISHER_QOS_DEFAULT), "publisher");
  fdds::DataWriterQos qos = publisher->get_default_datawriter_qos();
  apply(options, qos);
  return checked(
      publisher->create_datawriter(topic_of(participant, options.publish, type), qos, &listener),
      "writer");
}

struct Source {
  fdds::DataWriter* writer = nullptr;
  load::Sample sample;
};

bool write_sample(void* context, uint64_t number, int64_t written_ns) {
  auto& publisher = *static_cast<Source*>(context);
  publisher.sample.number(number);
  publisher.sample.written_ns(written_ns);
  return publisher.writer->write(&publisher.sample);
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = read_options(argc, argv);
  open_journal(&options);
  note_created();
  auto* participant = create_participant(options);
  fdds::TypeSupport type(new load::SamplePubSubType());
  type->auto_fill_type_object(false);
  type->auto_fill_type_information(false);
  type.register_type(participant);
  WriterListener writer_listener;
  ReaderListener reader_listener;
  Source publisher;
  if (options.subscribe != nullptr)
    start_subscriber(options, *participant, type.get_type_name(), reader_listener);
  if (options.publish != nullptr) {
    publisher.sample.writer(options.writer);
    publisher.sample.bytes().resize(options.size);
    publisher.writer =
        start_publisher(options, *participant, type.get_type_name(), writer_listener);
  }
  run_load(write_sample, &publisher);
  const int status = close_journal();
  std::fflush(stdout);
  participant->delete_contained_entities();
  fdds::DomainParticipantFactory::get_instance()->delete_participant(participant);
  return status;
}
