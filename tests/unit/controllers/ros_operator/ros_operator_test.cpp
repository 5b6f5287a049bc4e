#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <gtest/gtest.h>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <memory>
#include <optional>
#include <thread>

#include "inspectPubSubTypes.h"
#include "tests/support/test_domain.h"
#include "tests/unit/gateway/runtime/one_agent.h"

namespace {

using namespace std::chrono_literals;
using geometry_msgs::msg::dds_::Twist_;
using tests::Actions;
namespace api = eprosima::fastdds::dds;

/// Another node on the loopback interface: hears commands and tells where it is.
class Base {
 public:
  Base(int domain, const std::string& name) {
    api::DomainParticipantQos qos = api::PARTICIPANT_QOS_DEFAULT;
    const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    auto* const factory = api::DomainParticipantFactory::get_instance();
    participant_ = factory->create_participant(static_cast<std::uint32_t>(domain), qos);
    api::DataReaderQos reliable = api::DATAREADER_QOS_DEFAULT;
    reliable.reliability().kind = api::RELIABLE_RELIABILITY_QOS;
    reader_ = participant_->create_subscriber(api::SUBSCRIBER_QOS_DEFAULT)
                  ->create_datareader(
                      topic<geometry_msgs::msg::dds_::Twist_PubSubType>("rt/" + name + "/cmd_vel"),
                      reliable);
    writer_ = participant_->create_publisher(api::PUBLISHER_QOS_DEFAULT)
                  ->create_datawriter(
                      topic<nav_msgs::msg::dds_::Odometry_PubSubType>("rt/" + name + "/odom"),
                      api::DATAWRITER_QOS_DEFAULT);
  }
  ~Base() {
    participant_->delete_contained_entities();
    api::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  Base(const Base&) = delete;
  Base& operator=(const Base&) = delete;

  void await_operator() const {
    api::SubscriptionMatchedStatus commands;
    api::PublicationMatchedStatus odometry;
    while (commands.current_count == 0 || odometry.current_count == 0) {
      std::this_thread::sleep_for(5ms);
      reader_->get_subscription_matched_status(commands);
      writer_->get_publication_matched_status(odometry);
    }
  }
  /// The next that has come; none: not yet.
  std::optional<Twist_> command() const {
    Twist_ twist;
    api::SampleInfo info;
    while (reader_->take_next_sample(&twist, &info) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) return twist;
    }
    return std::nullopt;
  }
  void tell() const {
    nav_msgs::msg::dds_::Odometry_ odometry;
    writer_->write(&odometry);
  }

 private:
  template <class Type>
  api::Topic* topic(const std::string& name) {
    const api::TypeSupport type(new Type());
    type.register_type(participant_);
    return participant_->create_topic(name, type.get_type_name(), api::TOPIC_QOS_DEFAULT);
  }

  api::DomainParticipant* participant_;
  api::DataReader* reader_;
  api::DataWriter* writer_;
};

hal::node::exchange::AgentSession session(
    const std::string& interface, std::vector<hal::node::exchange::ParameterText> parameters) {
  auto session = tests::mote_session();
  session.air_interface = interface;
  session.parameters = std::move(parameters);
  return session;
}

hal::node::exchange::ParameterText robots(std::vector<std::string> names) {
  return {.name = "robots",
          .value = {},
          .place = "s.yaml:1:1",
          .is_list = true,
          .items = std::move(names)};
}

std::string mistake_of(const hal::node::exchange::AgentSession& agent) {
  const auto host =
      gateway::runtime::ControllerHost::create(*baraka_controller(), tests::session_of(agent));
  return host ? "" : host.error().message;
}

/// The last value of that name; 0: none.
double recorded(const Actions& actions, const std::string& name) {
  double value = 0;
  for (const auto& record : tests::all<hal::node::exchange::Record>(actions)) {
    if (record.name == name) value = record.value;
  }
  return value;
}

TEST(RosOperator, WithoutAnInterfaceSaysWhatToDo) {
  tests::OneAgent station(*baraka_controller(), session("", {}));
  const auto errors = tests::texts<hal::node::exchange::ControllerFailed>(station.start());
  ASSERT_EQ(errors.size(), 1);
  EXPECT_NE(errors[0].find("inside: true"), std::string::npos) << errors[0];
}

TEST(RosOperator, ParametersAreChecked) {
  EXPECT_EQ(mistake_of(session("lo", {robots({"r0", "fleet/r1", ""})})), "");
  for (const char* name : {"/r0", "r0/", "a b"}) {
    EXPECT_NE(mistake_of(session("lo", {robots({"r0", name})})), "") << name;
  }
  EXPECT_NE(mistake_of(session("lo", {{"rate", "0 Hz", "s.yaml:1:1"}})), "");
  EXPECT_NE(mistake_of(session("lo", {{"domain", "1.5", "s.yaml:1:1"}})), "");
}

TEST(RosOperator, CommandsEachRobotAtItsRateAndCountsWhatTheyTell) {
  const int domain = test_domain();
  tests::OneAgent station(*baraka_controller(),
                          session("lo", {{"domain", std::to_string(domain), "s.yaml:1:1"},
                                         robots({"r0", "fleet/r1"}),
                                         {"forward", "0.25 m/s", "s.yaml:3:1"},
                                         {"turn", "-0.5 rad/s", "s.yaml:4:1"},
                                         {"rate", "4 Hz", "s.yaml:5:1"}}));
  const Base r0(domain, "r0"), r1(domain, "fleet/r1");
  const Actions started = station.start();
  r0.await_operator();
  r1.await_operator();
  hal::Time next{};
  for (const auto& timer : tests::all<hal::node::exchange::SetTimer>(started)) next = timer.at;
  EXPECT_EQ(next, hal::Time{} + 250ms);
  // Its writers find readers a moment after these found them: what was sent meanwhile is nobody's.
  int sent = 1;
  for (std::optional<Twist_> first, second; !first || !second; ++sent) {
    station.now += 250ms;
    station.feed(station.event(hal::node::exchange::TimerDue{1}));
    std::this_thread::sleep_for(10ms);
    if (const auto one = r0.command()) first = one;
    if (const auto one = r1.command()) second = one;
    for (const auto& twist : {first, second}) {
      if (!twist) continue;
      EXPECT_EQ(twist->linear().x(), 0.25);
      EXPECT_EQ(twist->linear().y(), 0);
      EXPECT_EQ(twist->angular().z(), -0.5);
    }
  }
  EXPECT_EQ(recorded(station.control(), "commands"), sent);
  EXPECT_EQ(recorded(station.control(), "commands"), 0) << "it is told when there are more";
  // Likewise its readers and these writers.
  double heard = 0;
  while (heard == 0) {
    r0.tell();
    r1.tell();
    std::this_thread::sleep_for(5ms);
    heard = recorded(station.control(), "odometry");
  }
}

}  // namespace
