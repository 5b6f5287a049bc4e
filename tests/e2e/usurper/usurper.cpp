// Plays a server of somebody else's domain, or a controller of somebody else's robot, and says to
// be of a host that is not this one.
//
//   usurper DOMAIN refuse|grant|step|hello VERSION
//
// refuse, grant: Sessions to whoever says Hello, refusing its agents or granting it r0. step: the
// same as grant, and Steps that come after others. hello: asks for r0. VERSION is that of the
// protocol. Knows what travels (idl/) and DDS, and nothing of this project's code. Prints "heard:
// PROCESS" of each Hello and "granted" or "refused" of each Session that it gets.
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "exchangePubSubTypes.h"

namespace {

namespace api = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
namespace wire = baraka::exchange;
using ReturnCode_t = eprosima::fastrtps::types::ReturnCode_t;

constexpr int kPlace = 6;  // of the eight where controllers look for servers
constexpr const char* kNowhere = "nowhere";

rtps::Locator_t locator(int domain, int place) {
  rtps::Locator_t made;
  rtps::IPLocator::createLocator(LOCATOR_KIND_UDPv4, "127.0.0.1",
                                 static_cast<std::uint32_t>(7410 + 250 * domain + 2 * place), made);
  return made;
}

api::DomainParticipantQos qos(int domain, bool is_server) {
  api::DomainParticipantQos qos;
  const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {"127.0.0.1"};
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  auto& builtin = qos.wire_protocol().builtin;
  if (is_server) builtin.metatrafficUnicastLocatorList.push_back(locator(domain, kPlace));
  builtin.avoid_builtin_multicast = true;
  for (int place = 0; place < 8; ++place)
    builtin.initialPeersList.push_back(locator(domain, place));
  qos.wire_protocol().participant_id = 50 + kPlace;
  qos.name("baraka server");
  return qos;
}

class Usurper {
 public:
  Usurper(int domain, std::string mode, unsigned version)
      : mode_(std::move(mode)),
        version_(version),
        participant_(api::DomainParticipantFactory::get_instance()->create_participant(
            static_cast<std::uint32_t>(domain), qos(domain, mode_ != "hello"))) {
    if (participant_ == nullptr) std::exit(3);
    publisher_ = participant_->create_publisher(api::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(api::SUBSCRIBER_QOS_DEFAULT);
    if (mode_ == "hello") {
      hellos_ = writer<wire::HelloPubSubType>("baraka/hello", true);
      sessions_in_ = reader<wire::SessionPubSubType>("baraka/session");
    } else {
      sessions_ = writer<wire::SessionPubSubType>("baraka/session", true);
      hellos_in_ = reader<wire::HelloPubSubType>("baraka/hello");
    }
  }

  void act() {
    mode_ == "hello" ? ask() : usurp();
    std::fflush(stdout);
  }

 private:
  template <class Type>
  api::Topic* topic(const std::string& name) {
    const api::TypeSupport type(new Type());
    type->auto_fill_type_object(false);
    type->auto_fill_type_information(false);
    type.register_type(participant_);
    return participant_->create_topic(name, type.get_type_name(), api::TOPIC_QOS_DEFAULT);
  }
  template <class Type>
  api::DataWriter* writer(const std::string& name, bool is_watched) {
    api::DataWriterQos qos = api::DATAWRITER_QOS_DEFAULT;
    qos.reliability().kind = api::RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = api::TRANSIENT_LOCAL_DURABILITY_QOS;
    qos.resource_limits().max_instances = 1000;
    qos.resource_limits().max_samples_per_instance = 1;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    if (is_watched) {  // as its readers ask
      qos.liveliness().lease_duration = {1, 500'000'000};
      qos.liveliness().announcement_period = {0, 300'000'000};
    }
    return publisher_->create_datawriter(topic<Type>(name), qos);
  }
  template <class Type>
  api::DataReader* reader(const std::string& name) {
    api::DataReaderQos qos = api::DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = api::RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = api::TRANSIENT_LOCAL_DURABILITY_QOS;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    return subscriber_->create_datareader(topic<Type>(name), qos);
  }

  void ask() {
    wire::Hello hello;
    hello.instance("usurper");
    hello.version(version_);
    hello.process("usurper");
    hello.program("usurper");
    hello.identity().host(kNowhere);
    hello.identity().pid(1);
    hello.patterns({"r0"});
    hello.kind(wire::ROBOT);
    hello.both_kinds(true);
    if (asked_++ == 0) hellos_->write(&hello);
    wire::Session session;
    api::SampleInfo info;
    while (sessions_in_->take_next_sample(&session, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data || session.instance() != "usurper") continue;
      std::printf("%s\n", session.refusal().empty() ? "granted" : "refused");
    }
  }

  void usurp() {
    wire::Hello hello;
    api::SampleInfo info;
    while (hellos_in_->take_next_sample(&hello, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      std::printf("heard: %s\n", hello.process().c_str());
      heard_[hello.instance()] = hello.process();
      if (mode_ == "step" && steps_[hello.process()] == nullptr) {
        steps_[hello.process()] =
            writer<wire::StepPubSubType>("baraka/" + hello.process() + "/step", false);
      }
    }
    for (const auto& [instance, process] : heard_) say_session(instance);
    for (const auto& [process, writer] : steps_) say_step(*writer);
  }

  void say_session(const std::string& instance) {
    wire::Session session;
    session.instance(instance);
    session.server("usurper");
    session.version(version_);
    session.identity().host(kNowhere);
    session.identity().pid(1);
    session.run(7);
    if (mode_ == "refuse") {
      session.refusal("usurped");
    } else {
      wire::AgentSession agent;
      agent.name("r0");
      agent.kind(wire::ROBOT);
      agent.control_period(10'000'000);
      session.agents({agent});
    }
    sessions_->write(&session);
  }

  static void say_step(api::DataWriter& writer) {
    wire::Step step;
    step.server("usurper");
    step.run(7);
    step.sequence_number(7);  // after a first one that never was
    writer.write(&step);
  }

  std::string mode_;
  unsigned version_;
  api::DomainParticipant* participant_;
  api::Publisher* publisher_ = nullptr;
  api::Subscriber* subscriber_ = nullptr;
  api::DataWriter *hellos_ = nullptr, *sessions_ = nullptr;
  api::DataReader *hellos_in_ = nullptr, *sessions_in_ = nullptr;
  std::map<std::string, std::string> heard_;  ///< Processes by instance.
  std::map<std::string, api::DataWriter*> steps_;
  int asked_ = 0;
};

volatile std::sig_atomic_t has_ended = 0;

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  std::signal(SIGTERM, [](int) { has_ended = 1; });
  Usurper usurper(std::atoi(argv[1]), argv[2], static_cast<unsigned>(std::atoi(argv[3])));
  std::printf("ready\n");
  while (has_ended == 0) {
    usurper.act();
    std::this_thread::sleep_for(std::chrono::milliseconds{20});
  }
  std::_Exit(0);
}
