#include "controllers/traffic_source/traffic_source.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "controllers/traffic_stamp.h"
#include "tests/unit/gateway/runtime/one_agent.h"

namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Fate;
using hal::Time;
using hal::node::exchange::Action;
using hal::node::exchange::ControllerFailed;
using hal::node::exchange::Notice;
using hal::node::exchange::Record;
using hal::node::exchange::Send;
using hal::node::exchange::SetTimer;
using hal::node::exchange::Stop;
using hal::node::exchange::TimerDue;
using tests::Actions;
using Parameters = std::vector<hal::node::exchange::ParameterText>;

/// A source and its clock: timers run when they are due, sends are kept with their times.
class Source {
 public:
  explicit Source(Parameters parameters) {
    auto session = tests::mote_session();
    session.parameters = std::move(parameters);
    mote_ =
        std::make_unique<tests::OneAgent>(*baraka_controller(), session,
                                          std::vector<hal::node::exchange::AgentName>{
                                              {session.agent, session.name}, {AgentId{9}, "sink"}});
    take(mote_->start());
  }

  void run_until(hal::Duration until) {
    while (timer_ && *timer_ <= Time{until}) {
      mote_->now = *timer_;
      timer_.reset();
      take(mote_->feed(mote_->event(TimerDue{timer_id_})));
    }
    mote_->now = Time{until};
  }
  /// The timer is told of only now.
  void run_late(hal::Duration at) {
    timer_ = Time{at};
    run_until(at);
  }
  void notice(hal::MessageId id, Fate fate, hal::Duration at) {
    mote_->now = Time{at};
    take(mote_->feed(mote_->event(Notice{id, fate})));
  }
  void control(hal::Duration at) {
    mote_->now = Time{at};
    take(mote_->control());
  }
  std::map<std::string, double> stop() {
    take(mote_->feed(mote_->event(Stop{})));
    return recorded_;
  }

  std::vector<Send> sent;
  std::vector<Time> times;
  std::vector<std::string> errors;

 private:
  void take(const Actions& actions) {
    for (const Send& message : tests::all<Send>(actions)) {
      sent.push_back(message);
      times.push_back(mote_->now);
    }
    for (const auto& timer : tests::all<SetTimer>(actions)) {
      timer_ = timer.at;
      timer_id_ = timer.timer;
    }
    for (const auto& record : tests::all<Record>(actions)) recorded_[record.name] = record.value;
    for (const auto& error : tests::all<ControllerFailed>(actions)) errors.push_back(error.text);
  }

  std::unique_ptr<tests::OneAgent> mote_;
  std::optional<Time> timer_;
  hal::TimerId timer_id_ = 0;
  std::map<std::string, double> recorded_;
};

TEST(TrafficSource, SendsPeriodicallyFromItsPhaseUntilItsStop) {
  Source source({{"rate", "10 Hz", "t:1:1"},
                 {"phase", "30 ms", "t:2:1"},
                 {"start", "1 s", "t:3:1"},
                 {"stop", "2 s", "t:4:1"},
                 {"to", "sink", "t:5:1"},
                 {"size", "50", "t:6:1"}});
  source.run_until(10s);
  ASSERT_EQ(source.times.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(source.times[i], Time{1030ms + static_cast<int>(i) * 100ms});
    EXPECT_EQ(source.sent[i].destination, AgentId{9});
    ASSERT_EQ(source.sent[i].payload.size(), 50u);
    const auto stamp = controllers::stamp_in(source.sent[i].payload);
    ASSERT_TRUE(stamp);
    EXPECT_EQ(stamp->sent, source.times[i]);
    EXPECT_EQ(stamp->number, i + 1);
  }
  EXPECT_EQ(source.stop().at("sent"), 10);
}

TEST(TrafficSource, KeepsItsRateWhenItsTimersComeLate) {
  Source source(
      {{"rate", "10 Hz", "t:1:1"}, {"phase", "50 ms", "t:2:1"}, {"stop", "2 s", "t:3:1"}});
  source.run_until(100ms);
  ASSERT_EQ(source.times.size(), 1u);
  source.run_late(420ms);  // those of 150, 250 and 350 ms
  EXPECT_EQ(source.times.size(), 4u);
  source.run_until(460ms);
  EXPECT_EQ(source.times.back(), Time{450ms});
  source.run_late(3s);
  EXPECT_EQ(source.times.size(), 5u) << "its time is over";
  EXPECT_TRUE(source.errors.empty());
}

TEST(TrafficSource, DrawsAPhaseFromItsStreamIfItHasNone) {
  Source source({{"rate", "0.1 Hz", "t:1:1"}});
  source.run_until(100s);
  ASSERT_EQ(source.times.size(), 10u);
  EXPECT_LT(source.times.front(), Time{10s});
  EXPECT_NE(source.times.front(), Time{});
  EXPECT_EQ(source.times[1] - source.times[0], 10s);
  EXPECT_EQ(source.sent.front().destination, hal::kNeighbours);
}

// 10,000 exponential times of mean 10 ms: the mean has a deviation of 1 %, so does the deviation.
TEST(TrafficSource, SendsAsAPoissonProcess) {
  Source source({{"pattern", "poisson", "t:1:1"}, {"rate", "100 Hz", "t:2:1"}});
  source.run_until(100s);
  ASSERT_GT(source.times.size(), 9'000u);
  double sum = 0, squares = 0;
  for (std::size_t i = 1; i < source.times.size(); ++i) {
    const double gap = hal::to_seconds(source.times[i] - source.times[i - 1]);
    sum += gap;
    squares += gap * gap;
  }
  const double n = static_cast<double>(source.times.size() - 1);
  EXPECT_NEAR(sum / n, 0.01, 0.0004);
  EXPECT_NEAR(squares / n - (sum / n) * (sum / n), 1e-4, 1e-5);
}

TEST(TrafficSource, SendsBurstsAtTheRateThatIsAsked) {
  Source source({{"pattern", "bursts", "t:1:1"},
                 {"rate", "10 Hz", "t:2:1"},
                 {"burst", "5", "t:3:1"},
                 {"phase", "0 s", "t:4:1"}});
  source.run_until(1999ms);
  ASSERT_EQ(source.times.size(), 20u);
  EXPECT_EQ(source.times[4], Time{});
  EXPECT_EQ(source.times[5], Time{500ms});
}

TEST(TrafficSource, KeepsItsBacklogByNoticesAlone) {
  Source source({{"pattern", "saturated", "t:1:1"}, {"backlog", "3", "t:2:1"}});
  EXPECT_EQ(source.sent.size(), 3u);
  source.control(100ms);
  EXPECT_EQ(source.sent.size(), 3u) << "it does not poll";
  source.notice(1, Fate::kHandedOver, 110ms);
  source.notice(2, Fate::kFailed, 120ms);
  EXPECT_EQ(source.sent.size(), 5u);
  source.notice(3, Fate::kQueueFull, 130ms);
  EXPECT_EQ(source.sent.size(), 5u) << "more than the queue holds";
  const auto recorded = source.stop();
  EXPECT_EQ(recorded.at("handed_over"), 1);
  EXPECT_EQ(recorded.at("failed"), 1);
  EXPECT_EQ(recorded.at("queue_full"), 1);
}

TEST(TrafficSource, DoesNotSpinWhereEveryMessageFailsAtOnce) {
  Source source({{"pattern", "saturated", "t:1:1"}, {"backlog", "2", "t:2:1"}});
  source.notice(1, Fate::kFailed, 0s);
  source.notice(2, Fate::kFailed, 0s);
  EXPECT_EQ(source.sent.size(), 2u);
  source.control(100ms);
  EXPECT_EQ(source.sent.size(), 4u);
}

TEST(TrafficSource, NamesADestinationThatIsNotThere) {
  const Source nobody({{"to", "nobody", "t:1:1"}});
  EXPECT_EQ(nobody.errors, std::vector<std::string>{"to: there is no agent 'nobody'"});
  const Source itself({{"to", tests::mote_session().name, "t:1:1"}});
  ASSERT_EQ(itself.errors.size(), 1u);
  EXPECT_NE(itself.errors[0].find("the agent itself"), std::string::npos);
}

TEST(TrafficStamp, NeedsTwelveBytes) {
  EXPECT_EQ(controllers::stamped({.sent = Time{1s}, .number = 1}, 11), hal::Bytes(11));
  EXPECT_FALSE(controllers::stamp_in(hal::Bytes(11)));
  EXPECT_FALSE(controllers::stamp_in(hal::Bytes(100))) << "zeros alone";
  EXPECT_TRUE(controllers::stamp_in(controllers::stamped({.sent = Time{1s}, .number = 1}, 12)));
}

}  // namespace
