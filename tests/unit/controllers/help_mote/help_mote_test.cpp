#include <gtest/gtest.h>

#include "controllers/help_message.h"
#include "tests/unit/gateway/runtime/one_agent.h"

namespace {

using namespace std::chrono_literals;
using controllers::HelpMessage;
using controllers::HelpWord;
using hal::AgentId;
using tests::Actions;
using States = std::vector<std::string>;

constexpr AgentId kRobot{26};
constexpr AgentId kOther{27};

hal::Bytes bytes_of(const HelpMessage& message) {
  const auto bytes = controllers::encode(message);
  return {bytes.begin(), bytes.end()};
}

/// Who was told what.
using Said = std::vector<std::pair<int, HelpWord>>;
Said said(const Actions& actions) {
  Said words;
  for (const auto& message : tests::all<hal::node::exchange::Send>(actions)) {
    EXPECT_EQ(message.topic, "help");
    words.emplace_back(message.destination.value,
                       controllers::decode(message.payload).value().word);
  }
  return words;
}

const Said kCall = {{hal::kEveryone.value, HelpWord::kHelp}};

/// A mote that calls for help at 1 s, on a control cycle of 100 ms.
class HelpMote : public testing::Test {
 protected:
  Actions hear(AgentId from, HelpWord word, hal::Duration max_hop = {}) {
    return mote_->hear(from, "help", bytes_of({.word = word, .max_hop = max_hop}));
  }

  /// All that happens in the control cycles up to and including a time.
  Actions run_until(hal::Duration until) {
    Actions all;
    while (mote_->now < hal::Time{until}) {
      mote_->now += 100ms;
      for (auto& action : mote_->control()) all.push_back(std::move(action));
    }
    return all;
  }

  /// Repeats come exactly on time here.
  void SetUp() override {
    make({{"help_at", "1 s", "test:1:1"}, {"repeat_jitter", "0", "test:2:1"}});
  }

  void make(std::vector<hal::node::exchange::ParameterText> parameters) {
    auto session = tests::mote_session();
    session.parameters = std::move(parameters);
    mote_ = std::make_unique<tests::OneAgent>(*baraka_controller(), session);
    EXPECT_EQ(tests::states(mote_->start()), States{"IDLE"});
  }

  std::unique_ptr<tests::OneAgent> mote_;
};

TEST_F(HelpMote, CallsEveryoneAtTheGivenTimeAndNotBefore) {
  EXPECT_TRUE(run_until(900ms).empty());
  const Actions actions = run_until(1s);
  EXPECT_EQ(said(actions), kCall);
  EXPECT_EQ(tests::states(actions), States{"REQUEST"});
}

TEST_F(HelpMote, NeverCallsUnlessTold) {
  make({});
  EXPECT_TRUE(run_until(100s).empty());
}

TEST_F(HelpMote, CallsThreeMoreTimesEveryThirtySecondsThenGivesUp) {
  run_until(1s);
  for (const auto at : {31s, 61s, 91s}) {
    EXPECT_TRUE(run_until(at - 100ms).empty());
    EXPECT_EQ(said(run_until(at)), kCall);
  }
  EXPECT_TRUE(run_until(121s - 100ms).empty());
  const Actions end = run_until(121s);
  EXPECT_TRUE(said(end).empty());
  EXPECT_EQ(tests::states(end), States{"GAVE_UP"});
  EXPECT_EQ(said(hear(kRobot, HelpWord::kAsk)), (Said{{26, HelpWord::kRefuse}}));
}

TEST_F(HelpMote, GrantsTheFirstWhoAsksAndRefusesOthers) {
  run_until(1s);
  const Actions granted = hear(kRobot, HelpWord::kAsk);
  EXPECT_EQ(said(granted), (Said{{26, HelpWord::kGrant}}));
  EXPECT_EQ(tests::states(granted), States{"WAIT"});
  EXPECT_EQ(said(hear(kOther, HelpWord::kAsk)), (Said{{27, HelpWord::kRefuse}}));
}

TEST_F(HelpMote, AnswersEveryKeepAliveOfItsOwner) {
  run_until(1s);
  hear(kRobot, HelpWord::kAsk);
  for (int i = 0; i < 3; ++i) {
    const Actions answer = hear(kRobot, HelpWord::kAsk);
    EXPECT_EQ(said(answer), (Said{{26, HelpWord::kGrant}}));
    EXPECT_TRUE(tests::states(answer).empty()) << "it is waiting already";
  }
}

TEST_F(HelpMote, IsFulfilledWhenItsOwnerArrivesAndRefusesFromThenOn) {
  run_until(1s);
  hear(kRobot, HelpWord::kAsk);
  EXPECT_TRUE(hear(kOther, HelpWord::kArrived).empty()) << "not the owner";
  EXPECT_EQ(tests::states(hear(kRobot, HelpWord::kArrived)), States{"FULFILLED"});
  EXPECT_EQ(said(hear(kRobot, HelpWord::kAsk)), (Said{{26, HelpWord::kRefuse}}));
  EXPECT_TRUE(run_until(1000s).empty()) << "never calls again";
}

TEST_F(HelpMote, CallsAnewWhenItsOwnerGivesUp) {
  run_until(1s);
  hear(kRobot, HelpWord::kAsk);
  EXPECT_TRUE(hear(kOther, HelpWord::kGiveUp).empty()) << "not the owner";
  const Actions anew = hear(kRobot, HelpWord::kGiveUp);
  EXPECT_EQ(said(anew), kCall);
  EXPECT_EQ(tests::states(anew), States{"REQUEST"});
  EXPECT_EQ(said(hear(kOther, HelpWord::kAsk)), (Said{{27, HelpWord::kGrant}}));
}

TEST_F(HelpMote, HasAllItsRepeatsAgainWhenItCallsAnew) {
  run_until(61s);  // two repeats used up
  hear(kRobot, HelpWord::kAsk);
  hear(kRobot, HelpWord::kGiveUp);
  const Actions actions = run_until(61s + 120s);
  EXPECT_EQ(said(actions).size(), 3U);
  EXPECT_EQ(tests::states(actions), States{"GAVE_UP"});
}

TEST_F(HelpMote, WaitsAsLongAsTheOwnerSaidSinceItsLastWord) {
  run_until(1s);
  hear(kRobot, HelpWord::kAsk, 50s);
  run_until(41s);
  hear(kRobot, HelpWord::kAsk, 60s);
  EXPECT_TRUE(run_until(101s - 100ms).empty());
  EXPECT_EQ(said(run_until(101s)), kCall);
}

TEST_F(HelpMote, WaitsThreeHundredSecondsForARobotThatDoesNotSay) {
  run_until(1s);
  hear(kRobot, HelpWord::kAsk);
  EXPECT_TRUE(run_until(301s - 100ms).empty());
  EXPECT_EQ(tests::states(run_until(301s)), States{"REQUEST"});
}

TEST_F(HelpMote, RefusesWhoeverAsksBeforeItNeedsHelp) {
  EXPECT_EQ(said(hear(kRobot, HelpWord::kAsk)), (Said{{26, HelpWord::kRefuse}}));
  EXPECT_EQ(said(run_until(1s)), kCall);
}

TEST_F(HelpMote, LeavesOtherTopicsAndMalformedMessagesAlone) {
  run_until(1s);
  EXPECT_TRUE(mote_->hear(kRobot, "video", bytes_of({.word = HelpWord::kAsk})).empty());
  EXPECT_TRUE(mote_->hear(kRobot, "help", {2}).empty()) << "too short";
  EXPECT_TRUE(mote_->hear(kRobot, "help", {7, 0, 0, 0, 0}).empty()) << "no such word";
  EXPECT_TRUE(mote_->hear(kRobot, "help", {0, 0, 0, 0, 0}).empty()) << "no such word";
}

TEST(HelpMessage, IsAWordAndMillisecondsMostSignificantByteFirst) {
  // 300 s = 300000 ms = 0x000493e0
  const HelpMessage message{.word = HelpWord::kAsk, .max_hop = 300s};
  EXPECT_EQ(bytes_of(message), (hal::Bytes{2, 0x00, 0x04, 0x93, 0xe0}));
  EXPECT_EQ(controllers::decode(bytes_of(message)), message);
}

// 10 %: the default.
TEST_F(HelpMote, RepeatsItsCallEarlyByARandomShare) {
  make({{"help_at", "1 s", "test:1:1"}, {"max_repeats", "500", "test:2:1"}});
  run_until(1s);
  hal::Duration last = 1s;
  double total = 0;
  for (int i = 0; i < 500; ++i) {
    while (said(run_until(mote_->now.time_since_epoch() + 100ms)).empty()) {
    }
    const hal::Duration wait =
        mote_->now.time_since_epoch() - std::exchange(last, mote_->now.time_since_epoch());
    EXPECT_GT(wait, 26900ms);
    EXPECT_LE(wait, 30s);
    total += hal::to_seconds(wait);
  }
  // Mean of 30 s less U(0, 3 s), looked at every 100 ms: 28.55 s; standard error 0.039 s, 4 of
  // them.
  EXPECT_NEAR(total / 500, 28.55, 0.16);
}

TEST_F(HelpMote, CallsAboutSomethingNewEverySoOften) {
  make({{"help_at", "1 s", "test:1:1"}, {"help_every", "200 s", "test:2:1"}});
  run_until(1s);
  hear(kRobot, HelpWord::kAsk);
  EXPECT_EQ(tests::states(hear(kRobot, HelpWord::kArrived)), States{"FULFILLED"});
  EXPECT_TRUE(run_until(200900ms).empty());
  const Actions again = run_until(201s);
  EXPECT_EQ(said(again), kCall);
  EXPECT_EQ(tests::states(again), States{"REQUEST"});
  EXPECT_EQ(tests::states(run_until(400900ms)), States{"GAVE_UP"});
  EXPECT_EQ(tests::states(run_until(401s)), States{"REQUEST"}) << "also after it gave up";
}

TEST_F(HelpMote, LeavesOutACallThatFallsDueWhileAnotherOneIsOn) {
  make({{"help_at", "1 s", "test:1:1"}, {"help_every", "100 s", "test:2:1"}});
  run_until(1s);
  hear(kRobot, HelpWord::kAsk);
  EXPECT_TRUE(said(run_until(150s)).empty()) << "due at 101 s";
  hear(kRobot, HelpWord::kArrived);
  EXPECT_TRUE(run_until(200900ms).empty());
  EXPECT_EQ(said(run_until(201s)), kCall);
}

}  // namespace
