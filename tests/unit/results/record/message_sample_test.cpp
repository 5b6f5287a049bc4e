#include <gtest/gtest.h>

#include <memory>

#include "results/record/message_sample.h"
#include "results/record/recorder.h"
#include "tests/unit/results/record/test_run.h"

namespace results::record::test {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;

constexpr hal::MessageId kRoom = MessageSample::kRowsOfSecond;

class SampleOfMessages : public testing::Test {
 protected:
  explicit SampleOfMessages(sim::scenario::Detail messages = sim::scenario::Detail::kSample)
      : folder(testing::UnitTest::GetInstance()->current_test_info()->name()),
        recorder(std::make_unique<Recorder>(folder.file(), small_config(),
                                            RecorderOptions{.messages = messages})) {}

  std::string asked(const std::string& sql) {
    recorder->commit();
    return ask(folder.file(), sql);
  }

  static hal::Message message(hal::MessageId id, AgentId to, AgentId from = AgentId{1}) {
    return {.source = from, .destination = to, .id = id, .topic = "hello", .payload = {1, 2}};
  }

  /// Sends it and delivers it to these agents 1 us, 2 us, ... later, and reports its fate.
  void send(Time at, const hal::Message& message, const std::vector<AgentId>& receivers) {
    recorder->on_message_sent(at, message);
    hal::Duration delay{};
    for (const AgentId receiver : receivers) {
      recorder->on_message_delivered(at + (delay += 1us), receiver, message, 1);
    }
    recorder->on_fate(at + delay, message.source, message.id, hal::Fate::kHandedOver);
  }

  Folder folder;
  std::unique_ptr<Recorder> recorder;
};

TEST_F(SampleOfMessages, ListsThoseToOneAgentAndTheFirstOfTheOthersInEachSecond) {
  hal::MessageId id = 0;
  for (const Time second : {Time{1s}, Time{2s}}) {
    for (hal::MessageId i = 0; i < kRoom; ++i) {
      send(second, message(++id, hal::kNeighbours), {AgentId{2}});
      send(second, message(++id, AgentId{3}), {AgentId{3}});
    }
  }
  const std::string all = std::to_string(2 * kRoom);
  EXPECT_EQ(asked("SELECT COUNT(*) FROM messages WHERE destination = 3"), all);
  EXPECT_EQ(asked("SELECT COUNT(*) FROM deliveries WHERE receiver = 3"), all);
  EXPECT_EQ(asked("SELECT COUNT(*) FROM messages WHERE destination = 65534"), std::to_string(kRoom))
      << "half of the room of each second for them, half for deliveries";
  EXPECT_EQ(asked("SELECT COUNT(*) FROM deliveries WHERE receiver = 2"), std::to_string(kRoom));
  EXPECT_EQ(asked("SELECT MIN(id) || ' ' || MAX(id) FROM messages WHERE sent_ns = 2000000000"
                  " AND destination = 65534"),
            std::to_string(2 * kRoom + 1) + " " + std::to_string(3 * kRoom - 1));
  for (const char* to : {"3", "65534"}) {
    const std::string where = " WHERE destination = " + std::string(to);
    EXPECT_EQ(asked("SELECT SUM(count) || verdict FROM message_ends" + where), all + "delivered");
    EXPECT_EQ(asked("SELECT SUM(count) || fate FROM message_fates" + where), all + "handed over");
    EXPECT_EQ(asked("SELECT SUM(count) || ' ' || SUM(delay_sum_ns) || ' ' || SUM(late) || ' ' ||"
                    " SUM(bytes) FROM message_deliveries" +
                    where),
              all + " " + std::to_string(2 * kRoom * 1'000) + " 0 " + std::to_string(4 * kRoom));
  }
}

TEST_F(SampleOfMessages, IsOfAllSendersTogetherAndDecidedWhenTheyAreSent) {
  send(Time{1s}, message(1, hal::kEveryone), std::vector(kRoom - 1, AgentId{2}));
  recorder->on_message_sent(Time{1s}, message(1, hal::kEveryone, AgentId{2}));
  recorder->on_message_sent(Time{2s}, message(2, hal::kEveryone, AgentId{2}));
  recorder->on_message_delivered(Time{2s}, AgentId{3}, message(1, hal::kEveryone, AgentId{2}), 1);
  recorder->on_message_delivered(Time{2s}, AgentId{3}, message(2, hal::kEveryone, AgentId{2}), 1);
  EXPECT_EQ(asked("SELECT GROUP_CONCAT(sender || '.' || id) FROM messages"), "1.1,2.2");
  EXPECT_EQ(asked("SELECT GROUP_CONCAT(id) FROM deliveries WHERE sender = 2"), "2");
  EXPECT_EQ(asked("SELECT count FROM counted_deliveries WHERE sender = 2"), "1");
  EXPECT_EQ(asked("SELECT GROUP_CONCAT(messages || '/' || reached) FROM broadcast_sums"),
            "1/1,2/2");
}

TEST_F(SampleOfMessages, ANumberThatIsNotItsLatestIsAsItWasDecidedForIt) {
  send(Time{1s}, message(5, hal::kEveryone), std::vector(kRoom, AgentId{2}));
  send(Time{1s}, message(6, hal::kEveryone), {AgentId{2}});
  send(Time{1s}, message(4, hal::kEveryone), {AgentId{2}});
  EXPECT_EQ(asked("SELECT GROUP_CONCAT(id) FROM messages"), "4,5");
  EXPECT_EQ(asked("SELECT SUM(count) FROM counted_ends"), "1");
}

}  // namespace
}  // namespace results::record::test
