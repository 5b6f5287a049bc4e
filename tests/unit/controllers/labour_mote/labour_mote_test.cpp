#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>

#include "controllers/help_message.h"
#include "controllers/labour/sample_message.h"
#include "tests/unit/gateway/runtime/one_agent.h"

namespace {

using namespace std::chrono_literals;
using controllers::HelpWord;
using controllers::SampleMessage;
using hal::AgentId;
using hal::node::exchange::ControllerFailed;
using hal::node::exchange::Record;
using hal::node::exchange::Send;
using hal::node::exchange::SetTimer;
using hal::node::exchange::Stop;
using hal::node::exchange::TimerDue;
using tests::Actions;
using Parameters = std::vector<hal::node::exchange::ParameterText>;

constexpr AgentId kSelf{17};
constexpr AgentId kSink{9};
constexpr AgentId kRobot{26};

hal::node::exchange::ParameterText list(const char* name, std::vector<std::string> items) {
  return {.name = name, .value = {}, .place = "test:1:1", .is_list = true, .items = items};
}
hal::node::exchange::ParameterText value(const char* name, const char* text) {
  return {.name = name, .value = text, .place = "test:1:1"};
}

/// labour_mote, m17, on a control cycle of 100 ms, with its timers.
class LabourMote : public testing::Test {
 protected:
  Actions make(Parameters parameters) {
    auto session = tests::mote_session();
    session.parameters = std::move(parameters);
    mote_ = std::make_unique<tests::OneAgent>(
        *baraka_controller(), session,
        std::vector<hal::node::exchange::AgentName>{{kSelf, "m17"}, {kSink, "m9"}});
    return take(mote_->start());
  }

  /// Notes what the actions set, and gives them back.
  Actions take(Actions actions) {
    for (const auto& timer : tests::all<SetTimer>(actions)) timers_[timer.timer] = timer.at;
    for (const auto& record : tests::all<Record>(actions)) recorded_[record.name] = record.value;
    return actions;
  }

  /// Everything up to and including a time: timers when due, control cycles in between.
  Actions run_until(hal::Duration until) {
    Actions all;
    const auto add = [&](Actions some) {
      for (auto& action : take(std::move(some))) all.push_back(std::move(action));
    };
    for (hal::Time control = mote_->now + 100ms; control <= hal::Time{until}; control += 100ms) {
      for (;;) {
        const auto next =
            std::min_element(timers_.begin(), timers_.end(),
                             [](const auto& a, const auto& b) { return a.second < b.second; });
        if (next == timers_.end() || next->second > control) break;
        mote_->now = next->second;
        const auto due = mote_->event(TimerDue{next->first});
        timers_.erase(next);
        add(mote_->feed(due));
      }
      mote_->now = control;
      add(mote_->control());
    }
    return all;
  }

  /// Up to the first message of the next burst.
  Actions run_until_sent() {
    for (;;) {
      Actions actions = run_until(mote_->now.time_since_epoch() + 100ms);
      if (!tests::all<Send>(actions).empty()) return actions;
    }
  }

  Actions hear(AgentId from, const char* topic, hal::Bytes payload) {
    return take(mote_->hear(from, topic, std::move(payload)));
  }
  Actions hear_help(HelpWord word) {
    const auto bytes = controllers::encode(controllers::HelpMessage{.word = word});
    return hear(kRobot, "help", {bytes.begin(), bytes.end()});
  }

  static std::vector<SampleMessage> samples(const Actions& actions, const char* topic,
                                            std::size_t size) {
    std::vector<SampleMessage> found;
    for (const Send& message : tests::all<Send>(actions)) {
      EXPECT_EQ(message.topic, topic);
      EXPECT_EQ(message.destination, kSink);
      EXPECT_EQ(message.payload.size(), size);
      found.push_back(controllers::sample_in(message.payload).value());
    }
    return found;
  }

  std::unique_ptr<tests::OneAgent> mote_;
  std::map<hal::TimerId, hal::Time> timers_;
  std::map<std::string, double> recorded_;
};

/// Without a need for help it has the other task alone to choose from.
Parameters one_task(const char* task, const char* rest = "20 s") {
  return {list("tasks", {task, "help"}), value("sink", "m9"), value("rest", rest)};
}

constexpr double kUp = 0.3025 / (0.3025 + 0.25);    // P of weights 0.55 and 0.5
constexpr double kDown = 0.2025 / (0.2025 + 0.25);  // of 0.45 and 0.5

TEST_F(LabourMote, RecordsItsProbabilitiesAtTheStart) {
  make(one_task("temperature"));
  EXPECT_EQ(recorded_, (std::map<std::string, double>{{"p_temperature", 0.5}, {"p_help", 0.5}}));
}

TEST_F(LabourMote, SamplesTheTemperatureAndInclinesToItWithTheReceipt) {
  make(one_task("temperature"));
  const Actions first = run_until_sent();
  EXPECT_EQ(tests::states(first).front(), "TEMPERATURE");
  EXPECT_EQ(samples(first, "temperature", 16).at(0), (SampleMessage{1, 0, 1}));
  hear(AgentId{3}, "temperature", controllers::receipt_for(1));
  hear(kSink, "temperature", controllers::receipt_for(7));
  EXPECT_EQ(recorded_["p_temperature"], 0.5) << "not the sink, not this burst";
}

TEST_F(LabourMote, TakesAReceiptInTimeForASuccessAndNoneForAFailure) {
  make(one_task("temperature"));
  run_until_sent();
  EXPECT_EQ(tests::states(hear(kSink, "temperature", controllers::receipt_for(1))),
            std::vector<std::string>{"IDLE"});
  EXPECT_NEAR(recorded_["p_temperature"], kUp, 1e-15);
  EXPECT_NEAR(recorded_["p_help"], 1 - kUp, 1e-15);
  run_until_sent();
  const auto sent = mote_->now;
  run_until(sent.time_since_epoch() + 4900ms);
  EXPECT_NEAR(recorded_["p_temperature"], kUp, 1e-15) << "still in time";
  run_until(sent.time_since_epoch() + 5100ms);
  EXPECT_NEAR(recorded_["p_temperature"], 0.5, 1e-15);
}

TEST_F(LabourMote, RecordsWhatCameOfEachTaskWhenItDoesEvenIfNoWeightMoves) {
  Parameters at_the_most = one_task("temperature");
  at_the_most.push_back(value("weights.initial", "1"));
  make(at_the_most);
  for (const int burst : {1, 2}) {
    run_until_sent();
    hear(kSink, "temperature", controllers::receipt_for(burst));
    EXPECT_EQ(recorded_["succeeded_temperature"], burst);
    EXPECT_EQ(recorded_["p_temperature"], 0.5);
  }
  EXPECT_EQ(recorded_.count("failed_temperature"), 0u);
  run_until_sent();
  run_until(mote_->now.time_since_epoch() + 5100ms);
  EXPECT_EQ(recorded_["failed_temperature"], 1);
}

TEST_F(LabourMote, SendsABurstAtItsIntervalAndRests) {
  auto parameters = one_task("video", "1 h");
  parameters.push_back(value("video.messages", "5"));
  parameters.push_back(value("video.needed", "0.5"));
  make(parameters);
  Actions actions = run_until_sent();
  for (auto& action : run_until(mote_->now.time_since_epoch() + 100s)) {
    actions.push_back(std::move(action));
  }
  const auto all = samples(actions, "video", 1024);
  ASSERT_EQ(all.size(), 5u);
  for (std::uint16_t i = 0; i < 5; ++i) EXPECT_EQ(all[i], (SampleMessage{1, i, 3}));
  EXPECT_NEAR(recorded_["p_video"], kDown, 1e-15) << "no receipt";
}

TEST_F(LabourMote, NumbersItsBurstsOnAfterARestart) {
  make(one_task("temperature", "1 s"));
  run_until_sent();
  run_until(30s);
  const auto before = samples(run_until_sent(), "temperature", 16).at(0).burst;
  timers_.clear();
  take(mote_->start());
  EXPECT_GT(samples(run_until_sent(), "temperature", 16).at(0).burst, before);
}

TEST_F(LabourMote, HasOneNeedForAllThatARestartMadeItMiss) {
  auto parameters = one_task("temperature");
  parameters.push_back(value("help.at", "10 s"));
  parameters.push_back(value("help.every", "20 s"));
  make(parameters);
  mote_->now = hal::Time{95s};
  timers_.clear();
  take(mote_->start());
  run_until(105s);
  EXPECT_EQ(recorded_["needs"], 1) << "of 10, 30, 50, 70 and 90 s";
}

TEST_F(LabourMote, AsTheSinkAnswersEveryBurstOnceAndHasItsOwnAtOnce) {
  make({list("tasks", {"temperature", "help"}), value("sink", "m17"), value("rest", "1 h")});
  const auto say = [&](std::uint16_t index, std::uint32_t burst) {
    const auto bytes =
        controllers::encode(SampleMessage{.burst = burst, .index = index, .needed = 2}, 100);
    int receipts = 0;
    for (const Send& message : tests::all<Send>(hear(AgentId{3}, "audio", bytes))) {
      EXPECT_EQ(controllers::receipt_in(message.payload), burst);
      EXPECT_EQ(message.destination, AgentId{3});
      ++receipts;
    }
    return receipts;
  };
  EXPECT_EQ(say(4, 1), 0);
  EXPECT_EQ(say(4, 1), 0) << "the same message again";
  EXPECT_EQ(say(5, 1), 1);
  EXPECT_EQ(say(6, 1), 0) << "it has answered";
  EXPECT_EQ(say(0, 2), 0);
  EXPECT_EQ(say(1, 1), 0) << "a late one";
  EXPECT_EQ(say(1, 2), 1);
  hear(AgentId{3}, "audio", {1, 2, 3});  // no sample
  while (recorded_["p_temperature"] == 0.5) {
    EXPECT_TRUE(samples(run_until(mote_->now.time_since_epoch() + 1s), "", 0).empty());
  }
  EXPECT_NEAR(recorded_["p_temperature"], kUp, 1e-15);
  take(mote_->feed(mote_->event(Stop{})));
  EXPECT_EQ(recorded_["samples_audio"], 5);
  EXPECT_EQ(recorded_["succeeded_temperature"], 1);
  EXPECT_EQ(recorded_["failed_temperature"], 0);
}

/// Calls when it needs to, and chooses help: there is nothing else.
Parameters calls() {
  return {list("tasks", {"help", "temperature"}),
          value("sink", "m9"),
          value("rest", "1 h"),
          value("help.rest", "1 s"),
          value("help.at", "5 s"),
          value("help.every", "1000 s"),
          value("weights.initial", "1e-3"),
          value("weights.least", "1e-3"),
          value("weights.step", "1e-3")};
}

TEST_F(LabourMote, CallsForHelpOnceItNeedsIt) {
  make(calls());
  for (const auto& state : tests::states(run_until(4900ms))) EXPECT_NE(state, "REQUEST");
  EXPECT_EQ(recorded_.count("needs"), 0u);
  Actions later = run_until(5s);
  EXPECT_EQ(recorded_["needs"], 1);
  while (tests::states(later).empty() || tests::states(later).back() != "REQUEST") {
    ASSERT_LT(mote_->now, hal::Time{900s});
    later = run_until(mote_->now.time_since_epoch() + 100ms);
  }
  EXPECT_EQ(tests::states(hear_help(HelpWord::kAsk)), std::vector<std::string>{"WAIT"});
  const double before = recorded_["p_help"];
  EXPECT_EQ(tests::states(hear_help(HelpWord::kArrived)), std::vector<std::string>{"FULFILLED"});
  EXPECT_GT(recorded_["p_help"], before);
  for (const auto& state : tests::states(run_until(mote_->now.time_since_epoch() + 60s))) {
    EXPECT_NE(state, "REQUEST") << "no need any more";
  }
}

TEST_F(LabourMote, TakesACallThatNobodyAnsweredForAFailure) {
  auto parameters = calls();
  parameters[0] = list("tasks", {"help"});
  parameters.push_back(value("help.max_repeats", "0"));
  make(parameters);
  run_until(60s);
  take(mote_->feed(mote_->event(Stop{})));
  EXPECT_EQ(recorded_["failed_help"], 1);
  EXPECT_EQ(recorded_["p_help"], 1);
}

TEST_F(LabourMote, SaysWhichTaskNeedsASinkAndWhichSinkIsNone) {
  const auto mistake = [this](Parameters parameters) {
    return tests::texts<ControllerFailed>(make(std::move(parameters))).at(0);
  };
  EXPECT_NE(mistake({}).find("sink: is not given; the task 'temperature' needs one"),
            std::string::npos);
  EXPECT_NE(mistake({value("sink", "m99")}).find("sink: there is no agent 'm99'"),
            std::string::npos);
}

}  // namespace
