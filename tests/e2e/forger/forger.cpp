// Answers the Steps of somebody else's controller process, faster than that if it can: the robot
// drives forward, and every agent enters the state FULFILLED.
//
//   forger DOMAIN PROCESS
//
// Knows what travels (idl/) and DDS, and nothing of this project's code. Prints "forged: N" for
// each thousand and at SIGTERM.
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <memory>
#include <string>

#include "exchangePubSubTypes.h"

namespace {

namespace api = eprosima::fastdds::dds;
namespace wire = baraka::exchange;

wire::Action drive(const wire::Event& event, std::uint32_t index) {
  wire::Drive forward;
  forward.vx(0.5);  // m/s
  wire::Action action;
  action.agent(event.agent());
  action.event(index);
  action.kind(wire::DRIVE_BODY);
  action.drive({forward});
  return action;
}

wire::Action fulfilled(const wire::Event& event, std::uint32_t index) {
  wire::Action action;
  action.agent(event.agent());
  action.event(index);
  action.kind(wire::STATE);
  action.text("FULFILLED");
  return action;
}

class Forger : public api::DataReaderListener {
 public:
  Forger(int domain, const std::string& process) : process_(process) {
    participant_ = api::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<std::uint32_t>(domain), qos(domain));
    const api::TypeSupport step(new wire::StepPubSubType()), reply(new wire::ReplyPubSubType());
    for (const api::TypeSupport& type : {step, reply}) {
      type->auto_fill_type_object(false);
      type->auto_fill_type_information(false);
      type.register_type(participant_);
    }
    const std::string stem = "baraka/" + process;
    auto* const replies =
        participant_->create_topic(stem + "/reply", reply.get_type_name(), api::TOPIC_QOS_DEFAULT);
    auto* const steps =
        participant_->create_topic(stem + "/step", step.get_type_name(), api::TOPIC_QOS_DEFAULT);
    api::DataWriterQos writer = api::DATAWRITER_QOS_DEFAULT;
    writer.reliability().kind = api::RELIABLE_RELIABILITY_QOS;
    writer.durability().kind = api::TRANSIENT_LOCAL_DURABILITY_QOS;
    writer_ = participant_->create_publisher(api::PUBLISHER_QOS_DEFAULT)
                  ->create_datawriter(replies, writer);
    api::DataReaderQos reader = api::DATAREADER_QOS_DEFAULT;
    reader.reliability().kind = api::RELIABLE_RELIABILITY_QOS;
    participant_->create_subscriber(api::SUBSCRIBER_QOS_DEFAULT)
        ->create_datareader(steps, reader, this);
  }

  void on_data_available(api::DataReader* reader) override {
    wire::Step step;
    api::SampleInfo info;
    while (reader->take_next_sample(&step, &info) == ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) answer(step);
    }
  }

 private:
  using ReturnCode_t = eprosima::fastrtps::types::ReturnCode_t;

  /// As a controller's, but for what `initialPeersList` says: a program of this host that looks for
  /// servers at their places.
  static api::DomainParticipantQos qos(int domain) {
    api::DomainParticipantQos qos;
    const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    for (int place = 0; place < 8; ++place) {
      eprosima::fastrtps::rtps::Locator_t server;
      eprosima::fastrtps::rtps::IPLocator::createLocator(
          LOCATOR_KIND_UDPv4, "127.0.0.1",
          static_cast<std::uint32_t>(7410 + 250 * domain + 2 * place), server);
      qos.wire_protocol().builtin.initialPeersList.push_back(server);
    }
    qos.wire_protocol().participant_id = 60;
    return qos;
  }

  void answer(const wire::Step& step) {
    wire::Reply reply;
    reply.server(step.server());
    reply.process(process_);
    reply.run(step.run());
    for (std::uint32_t i = 0; i < step.events().size(); ++i) {
      reply.actions().push_back(drive(step.events()[i], i));
      reply.actions().push_back(fulfilled(step.events()[i], i));
    }
    // Of this Step, and of the next one before it is asked.
    for (const unsigned ahead : {0U, 1U}) {
      reply.sequence_number(step.sequence_number() + ahead);
      writer_->write(&reply);
    }
    if (++forged_ % 10 == 1) {
      std::printf("forged: %lu\n", forged_);
      std::fflush(stdout);
    }
  }

  std::string process_;
  api::DomainParticipant* participant_ = nullptr;
  api::DataWriter* writer_ = nullptr;
  unsigned long forged_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const Forger forger(std::atoi(argv[1]), argv[2]);
  std::printf("ready\n");
  std::fflush(stdout);
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  int signal = 0;
  sigwait(&signals, &signal);
  std::_Exit(0);
}
