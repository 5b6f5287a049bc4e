#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <gtest/gtest.h>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <limits>
#include <memory>
#include <thread>

#include "hal/types/printable.h"
#include "inspectPubSubTypes.h"
#include "tests/support/test_domain.h"
#include "tests/unit/gateway/runtime/one_agent.h"

namespace {

using namespace std::chrono_literals;
using hal::node::exchange::ControllerFailed;
using hal::node::exchange::Log;
using hal::node::exchange::SetState;
using tests::Actions;
namespace api = eprosima::fastdds::dds;

/// Another node on the loopback interface, which commands velocities.
class Commander {
 public:
  Commander(int domain, const std::string& topic) {
    api::DomainParticipantQos qos = api::PARTICIPANT_QOS_DEFAULT;
    const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    auto* const factory = api::DomainParticipantFactory::get_instance();
    participant_ = factory->create_participant(static_cast<std::uint32_t>(domain), qos);
    const api::TypeSupport type(new geometry_msgs::msg::dds_::Twist_PubSubType());
    type.register_type(participant_);
    api::DataWriterQos reliable = api::DATAWRITER_QOS_DEFAULT;
    reliable.reliability().kind = api::RELIABLE_RELIABILITY_QOS;
    writer_ = participant_->create_publisher(api::PUBLISHER_QOS_DEFAULT)
                  ->create_datawriter(participant_->create_topic(topic, type.get_type_name(),
                                                                 api::TOPIC_QOS_DEFAULT),
                                      reliable);
  }
  ~Commander() {
    participant_->delete_contained_entities();
    api::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  Commander(const Commander&) = delete;
  Commander& operator=(const Commander&) = delete;

  void await_reader() const {
    api::PublicationMatchedStatus status;
    while (status.current_count == 0) {
      std::this_thread::sleep_for(5ms);
      writer_->get_publication_matched_status(status);
    }
  }
  void command(double vx, double omega) const {
    geometry_msgs::msg::dds_::Twist_ twist;
    twist.linear().x(vx);
    twist.angular().z(omega);
    writer_->write(&twist);
  }

 private:
  api::DomainParticipant* participant_;
  api::DataWriter* writer_;
};

hal::node::exchange::AgentSession session(
    const std::string& interface, std::vector<hal::node::exchange::ParameterText> parameters) {
  auto session = tests::robot_session();
  session.air_interface = interface;
  session.parameters = std::move(parameters);
  return session;
}

hal::Twist2 driven(const Actions& actions) {
  hal::Twist2 twist{std::numeric_limits<double>::quiet_NaN(), 0, 0};
  for (const auto& drive : tests::all<hal::node::exchange::DriveBody>(actions)) twist = drive.twist;
  return twist;
}

std::string mistake_of(const hal::node::exchange::AgentSession& agent) {
  const auto host =
      gateway::runtime::ControllerHost::create(*baraka_controller(), tests::session_of(agent));
  return host ? "" : host.error().message;
}

TEST(RosBase, WithoutAnInterfaceSaysWhatToDo) {
  tests::OneAgent robot(*baraka_controller(), session("", {}));
  const auto errors = tests::texts<ControllerFailed>(robot.start());
  ASSERT_EQ(errors.size(), 1);
  EXPECT_NE(errors[0].find("inside: true"), std::string::npos) << errors[0];
}

TEST(RosBase, AnInterfaceThatIsNotThereIsNamed) {
  tests::OneAgent robot(*baraka_controller(), session("wlan77", {}));
  const auto errors = tests::texts<ControllerFailed>(robot.start());
  ASSERT_EQ(errors.size(), 1);
  EXPECT_NE(errors[0].find("no network interface 'wlan77' with an IPv4 address"),
            std::string::npos);
}

TEST(RosBase, ParametersAreChecked) {
  EXPECT_NE(mistake_of(session("lo", {{"domain", "233", "s.yaml:1:1"}})), "");
  EXPECT_NE(mistake_of(session("lo", {{"domain", "1.5", "s.yaml:1:1"}})), "");
  EXPECT_NE(mistake_of(session("lo", {{"command_timeout", "0 s", "s.yaml:1:1"}})), "");
  EXPECT_NE(mistake_of(session("lo", {{"odom_frame", "", "s.yaml:1:1"}})), "");
  for (const char* name : {"/r0", "r0/", "0r", "a//b", "a b"}) {
    EXPECT_NE(mistake_of(session("lo", {{"namespace", name, "s.yaml:1:1"}})), "") << name;
  }
  EXPECT_EQ(mistake_of(session("lo", {{"namespace", "fleet/r0", "s.yaml:1:1"}})), "");
  EXPECT_EQ(mistake_of(session("lo", {{"namespace", "fleet/{}", "s.yaml:1:1"}})), "");
}

std::string mistake_in_list(const std::string& parameter, std::vector<std::string> items) {
  return mistake_of(session("lo", {{parameter, "", "s.yaml:1:1", true, std::move(items)}}));
}

TEST(RosBase, ListsOfTopicsAndNamesAreChecked) {
  EXPECT_NE(mistake_in_list("topics", {"odom", "scann"}).find("scann"), std::string::npos);
  EXPECT_EQ(mistake_in_list("topics", {}), "");
  EXPECT_NE(mistake_in_list("best_effort_topics", {"map"}), "");
  EXPECT_NE(mistake_in_list("remap", {"scan=laser"}).find("FROM:=TO"), std::string::npos);
  EXPECT_NE(mistake_in_list("remap", {"tf:=r0/tf"}).find("no topic 'tf'; there are odom, /tf, "),
            std::string::npos);
  EXPECT_NE(mistake_in_list("remap", {"scan:=a b"}), "");
  EXPECT_EQ(mistake_in_list("remap", {"scan:=front/scan", "/tf:=tf", "cmd_vel:=/cmd_vel"}), "");
  EXPECT_NE(mistake_in_list("pose_covariance_diagonal", {"0.1", "0.1"}).find("2 numbers"),
            std::string::npos);
  EXPECT_EQ(mistake_in_list("pose_covariance_diagonal", {"0.1", "0.1", "0", "0", "0", "1"}), "");
}

TEST(RosBase, AClockThatNoStampIsOfIsPointedOut) {
  const hal::ControllerKind& kind = *baraka_controller();
  hal::Parameters::Values values;
  for (const hal::ParameterSpec& spec : kind.parameters)
    values.emplace(spec.name, spec.default_value);
  EXPECT_TRUE(kind.judge(hal::Parameters(values)).empty());
  values.at("publish_clock") = true;
  const auto mistakes = kind.judge(hal::Parameters(values));
  ASSERT_EQ(mistakes.size(), 1);
  EXPECT_EQ(mistakes[0].name, "publish_clock");
  EXPECT_TRUE(mistakes[0].can_work);
  values.at("publish_clock") = false;
  values.at("topics") = std::vector<std::string>{"odom", "clock"};
  EXPECT_EQ(kind.judge(hal::Parameters(values)).size(), 1);
  values.at("use_sim_time") = true;
  EXPECT_TRUE(kind.judge(hal::Parameters(values)).empty());
}

TEST(RosBase, AnAgentWhoseNameIsNoNamespaceIsAnError) {
  auto named = session("lo", {{"namespace", "{}", "s.yaml:1:1"}});
  named.name = "robot-1";
  tests::OneAgent robot(*baraka_controller(), named);
  const auto errors = tests::texts<ControllerFailed>(robot.start());
  ASSERT_EQ(errors.size(), 1);
  EXPECT_NE(errors[0].find("namespace: 'robot-1' must be words"), std::string::npos) << errors[0];
}

class CommandedBase : public testing::Test {
 protected:
  /// Control cycles of 100 ms, until one of them enters a state.
  Actions await(const std::string& state) {
    while (true) {
      std::this_thread::sleep_for(10ms);
      const Actions actions = cycle();
      const auto states = tests::texts<SetState>(actions);
      if (!states.empty() && states.back() == state) return actions;
    }
  }
  Actions cycle() {
    robot_.now += 100ms;
    return robot_.control();
  }

  const int domain_ = test_domain();
  tests::OneAgent robot_{*baraka_controller(),
                         session("lo", {{"domain", std::to_string(domain_), "s.yaml:1:1"},
                                        {"namespace", "r0", "s.yaml:2:1"},
                                        {"command_timeout", "400 ms", "s.yaml:3:1"}})};
};

TEST_F(CommandedBase, DrivesAsTheLastCommandSaysAndStopsWhenNoneComes) {
  Commander commander(domain_, "rt/r0/cmd_vel");
  EXPECT_EQ(tests::texts<SetState>(robot_.start()), std::vector<std::string>{"waiting"});
  EXPECT_EQ(driven(cycle()), hal::Twist2{});
  commander.await_reader();
  commander.command(0.1, 0.25);
  const Actions first = await("driving");
  EXPECT_EQ(driven(first), (hal::Twist2{0.1, 0, 0.25}));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(driven(cycle()), (hal::Twist2{0.1, 0, 0.25})) << i;
  const Actions last = cycle();  // 400 ms after
  EXPECT_EQ(driven(last), hal::Twist2{});
  EXPECT_EQ(tests::texts<SetState>(last), std::vector<std::string>{"stopped"});
  commander.command(-0.1, 0);
  const Actions again = await("driving");
  EXPECT_EQ(driven(again), (hal::Twist2{-0.1, 0, 0}));
  double recorded = 0;
  for (const auto& record : tests::all<hal::node::exchange::Record>(again)) recorded = record.value;
  EXPECT_EQ(recorded, 2);
}

TEST_F(CommandedBase, SenselessCommandsAreDroppedAndLogged) {
  Commander commander(domain_, "rt/r0/cmd_vel");
  robot_.start();
  commander.await_reader();
  commander.command(0.05, 0);
  await("driving");
  commander.command(std::numeric_limits<double>::quiet_NaN(), 0);
  commander.command(0.1, 0);
  std::vector<std::string> lines;
  for (Actions actions; driven(actions) != hal::Twist2{0.1, 0, 0};) {
    std::this_thread::sleep_for(10ms);
    actions = cycle();
    for (const auto& line : tests::texts<Log>(actions)) lines.push_back(line);
  }
  ASSERT_EQ(lines.size(), 1);
  EXPECT_EQ(lines[0], "a command has a value that is not finite: dropped");
}

}  // namespace
