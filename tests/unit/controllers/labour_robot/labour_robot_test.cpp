#include <gtest/gtest.h>

#include <algorithm>

#include "controllers/labour/sample_message.h"
#include "tests/unit/controllers/help_robot/robot_bench.h"

namespace {

using namespace std::chrono_literals;
using controllers::HelpWord;
using hal::AgentId;
using hal::node::exchange::ControllerFailed;
using hal::node::exchange::Record;
using hal::node::exchange::Send;
using hal::node::exchange::Stop;
using tests::Actions;
using Parameters = std::vector<hal::node::exchange::ParameterText>;
using Said = tests::RobotBench::Said;
using States = std::vector<std::string>;

constexpr int kMote = 17;
constexpr int kPost = 6;
constexpr AgentId kSink{9};

hal::node::exchange::ParameterText list(const char* name, std::vector<std::string> items) {
  return {.name = name, .value = {}, .place = "test:1:1", .is_list = true, .items = items};
}
hal::node::exchange::ParameterText value(const char* name, const char* text) {
  return {.name = name, .value = text, .place = "test:1:1"};
}

class LabourRobot : public testing::Test {
 protected:
  Actions make(Parameters parameters) {
    bench_ = std::make_unique<tests::RobotBench>(
        std::move(parameters),
        std::vector<hal::node::exchange::AgentName>{
            {AgentId{26}, "r0"}, {kSink, "m9"}, {AgentId{kPost}, "m6"}, {AgentId{kMote}, "m17"}});
    return take(bench_->agent->start());
  }

  Actions take(Actions actions) {
    for (const auto& record : tests::all<Record>(actions)) recorded_[record.name] = record.value;
    return actions;
  }
  Actions hear(int from, HelpWord word) { return take(bench_->hear(from, word)); }
  Actions control() { return take(bench_->control()); }
  Actions run_for(hal::Duration time) {
    return take(bench_->run_until(bench_->agent->now.time_since_epoch() + time));
  }
  void stop() { take(bench_->agent->feed(bench_->agent->event(Stop{}))); }

  /// Lets the mote call until the robot asks for the task.
  void call_until_asked() {
    for (int i = 0; i < 200; ++i) {
      hear(kMote, HelpWord::kHelp);
      if (tests::RobotBench::said(control()) == Said{{kMote, HelpWord::kAsk}}) return;
    }
    FAIL() << "it never answers";
  }

  std::unique_ptr<tests::RobotBench> bench_;
  std::map<std::string, double> recorded_;
};

const Parameters kAnswerAndIdle = {list("tasks", {"answer", "idle"})};
constexpr double kUp = 0.3025 / (0.3025 + 0.25);    // P of weights 0.55 and 0.5
constexpr double kDown = 0.2025 / (0.2025 + 0.25);  // of 0.45 and 0.5

TEST_F(LabourRobot, AnswersAtOnceIfThatIsItsOnlyTask) {
  make({list("tasks", {"answer"})});
  EXPECT_TRUE(control().empty()) << "nobody called";
  hear(kMote, HelpWord::kHelp);
  EXPECT_EQ(tests::states(control()), (States{"SELECT_DESTINATION", "REQUEST_ASSIGNMENT"}));
}

TEST_F(LabourRobot, BreaksOffBeingIdleForOneOfTheCalls) {
  make({list("tasks", {"answer", "idle"}), value("idle.lasts", "1 h")});
  control();
  call_until_asked();
  hear(kMote, HelpWord::kRefuse);
  stop();
  EXPECT_EQ(recorded_["failed_idle"], 0) << "broken off, not failed";
  EXPECT_EQ(recorded_["succeeded_idle"], 0);
}

TEST_F(LabourRobot, InclinesToAnswersWhenItArrived) {
  make(kAnswerAndIdle);
  control();
  call_until_asked();
  bench_->learn(kMote, kMote, 1);
  bench_->positions = {{kMote, {5, 0}}};
  hear(kMote, HelpWord::kGrant);
  control();
  control();
  stop();
  EXPECT_EQ(recorded_["succeeded_answer"], 1);
  EXPECT_NEAR(recorded_["p_answer"], kUp, 1e-15);
}

TEST_F(LabourRobot, LeavesCallsToOthersWhenItWasRefused) {
  make(kAnswerAndIdle);
  control();
  call_until_asked();
  hear(kMote, HelpWord::kRefuse);
  control();
  EXPECT_NEAR(recorded_["p_answer"], kDown, 1e-15);
  EXPECT_NEAR(recorded_["p_idle"], 1 - kDown, 1e-15);
  EXPECT_EQ(recorded_["failed_answer"], 1) << "told when it happens";
  EXPECT_EQ(recorded_.count("succeeded_answer"), 0u);
}

TEST_F(LabourRobot, LearnsNothingOfARefusalIfThatIsNoFailure) {
  make({list("tasks", {"answer", "idle"}), value("answer.refused", "nothing")});
  control();
  call_until_asked();
  hear(kMote, HelpWord::kRefuse);
  control();
  EXPECT_EQ(recorded_.count("failed_answer"), 0u);
  stop();
  EXPECT_EQ(recorded_["p_answer"], 0.5);
  EXPECT_EQ(recorded_["failed_answer"], 0);
}

TEST_F(LabourRobot, IsRightToBeIdleUnlessSomebodyCalls) {
  make({list("tasks", {"answer", "idle"}), value("idle.lasts", "10 s")});
  run_for(16s);  // 15 s at most
  EXPECT_NEAR(recorded_["p_idle"], kUp, 1e-15);
}

TEST_F(LabourRobot, ForgetsCallsThatAreNotRepeated) {
  make({list("tasks", {"answer"}), value("answer.fresh_for", "35 s")});
  hear(kMote, HelpWord::kHelp);
  control();
  hear(3, HelpWord::kHelp);  // while it asks the other one
  run_for(36s);
  hear(kMote, HelpWord::kRefuse);
  EXPECT_TRUE(tests::RobotBench::said(control()).empty());
}

/// Of two motes that called: how often the first is asked in 200 tries.
TEST_F(LabourRobot, PrefersTheMoteWithTheBetterRoute) {
  const auto first_of = [this](int hops, const char* beta) {
    int asked = 0;
    make({list("tasks", {"answer"}), value("answer.requester_beta", beta)});
    bench_->learn(3, 5, hops);
    bench_->learn(kMote, 5, 2);
    for (int i = 0; i < 200; ++i) {
      hear(3, HelpWord::kHelp);
      hear(kMote, HelpWord::kHelp);
      const auto first = tests::RobotBench::said(control());
      asked += first == Said{{3, HelpWord::kAsk}} ? 1 : 0;
      hear(first.at(0).first, HelpWord::kRefuse);
      const auto second = tests::RobotBench::said(control());
      hear(second.at(0).first, HelpWord::kRefuse);
      control();
    }
    return asked;
  };
  // (1/4)^2 / ((1/4)^2 + (1/2)^2) = 0.2 of 200: 40, and 4 sigma are 23.
  EXPECT_NEAR(first_of(4, "2"), 40, 23);
  EXPECT_NEAR(first_of(4, "0"), 100, 29);
  EXPECT_EQ(first_of(30, "20"), 0);
}

TEST_F(LabourRobot, ReportsFromItsPostAndStaysThere) {
  make({list("tasks", {"patrol", "answer"}), list("patrol.posts", {"m6"}), value("sink", "m9"),
        value("patrol.stay", "20 s")});
  EXPECT_TRUE(tests::states(control()).empty()) << "the post is not in sight";
  bench_->positions = {{kPost, {100, 0}}};
  control();
  EXPECT_EQ(tests::states(control()), States{});
  bench_->positions = {{kPost, {3.9, 0}}};
  const Actions there = control();
  EXPECT_EQ(tests::states(there), States{"GATEWAY"});
  const auto reports = tests::all<Send>(there);
  ASSERT_FALSE(reports.empty());
  EXPECT_EQ(reports[0].topic, "patrol");
  EXPECT_EQ(reports[0].destination, kSink);
  take(bench_->agent->hear(kSink, "patrol", controllers::receipt_for(1)));
  bench_->positions.clear();
  const Actions after = run_for(20100ms);
  EXPECT_EQ(tests::states(after), States{"IDLE"});
  EXPECT_NEAR(recorded_["p_patrol"], kUp, 1e-15);
}

TEST_F(LabourRobot, FailsAPatrolThatComesTooLateOrIsNotHeardOf) {
  make({list("tasks", {"patrol", "answer"}), list("patrol.posts", {"m6"}), value("sink", "m9"),
        value("patrol.timeout", "60 s"), value("patrol.stay", "20 s")});
  bench_->positions = {{kPost, {100, 0}}};
  control();
  run_for(60100ms);
  EXPECT_NEAR(recorded_["p_patrol"], kDown, 1e-15) << "not reached";
  bench_->positions = {{kPost, {1, 0}}};
  run_for(200ms);
  bench_->positions.clear();
  run_for(21s);
  stop();
  EXPECT_EQ(recorded_["failed_patrol"], 2) << "no receipt";
}

TEST_F(LabourRobot, SaysWhatAPatrolLacks) {
  const auto mistake = [this](Parameters parameters) {
    return tests::texts<ControllerFailed>(make(std::move(parameters))).at(0);
  };
  EXPECT_NE(mistake({}).find("sink: is not given; the task 'patrol' needs one"), std::string::npos);
  EXPECT_NE(mistake({value("sink", "m9")}).find("patrol.posts: is empty"), std::string::npos);
  EXPECT_NE(mistake({value("sink", "m9"), list("patrol.posts", {"m6", "m99"})})
                .find("patrol.posts: there is no agent 'm99'"),
            std::string::npos);
  EXPECT_NE(mistake({value("sink", "m9"), list("patrol.posts", {"m6", "m6"})})
                .find("patrol.posts: 'm6' is there twice"),
            std::string::npos);
}

}  // namespace
