#include "results/record/station_queues.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "tests/unit/results/record/test_run.h"

namespace results::record {
namespace {

using namespace std::chrono_literals;
using hal::Time;
using sim::radio::AccessCategory;
using sim::radio::QueueChange;
using What = sim::radio::QueueChange::What;

constexpr hal::AgentId kStation{4}, kNext{2};

class StationQueuesTest : public testing::Test {
 protected:
  StationQueuesTest()
      : folder_(testing::UnitTest::GetInstance()->current_test_info()->name()),
        database_(folder_.file(), Database::Mode::kCreate) {
    create_tables(database_);
    queues.emplace(database_);
  }

  void change(hal::Duration at, What what, std::size_t bytes,
              hal::Verdict verdict = hal::Verdict::kDelivered) {
    queues->on_queue(Time{at}, {.station = kStation,
                                .receiver = kNext,
                                .category = category,
                                .what = what,
                                .bytes = bytes,
                                .verdict = verdict});
  }
  std::string ask(const std::string& sql) {
    Statement query(database_, sql);
    return query.next() ? query.text(0) : "none";
  }
  std::string row(const std::string& name) {
    return ask(
        "SELECT frames || ' ' || waiting || ' ' || most || ' ' || most_bytes || ' ' ||"
        " waited_ns FROM station_queues WHERE agent = 4 AND receiver = 2 AND category = '" +
        name + "'");
  }
  std::string drops() {
    return ask(
        "SELECT GROUP_CONCAT(verdict || ' ' || count, ', ') FROM (SELECT * FROM"
        " station_queue_drops WHERE agent = 4 AND receiver = 2 ORDER BY verdict)");
  }

  std::optional<AccessCategory> category = AccessCategory::kVoice;
  test::Folder folder_;
  Database database_;

 public:
  std::optional<StationQueues> queues;  ///< Ends before its database.
};

TEST_F(StationQueuesTest, TellsDepthAndTime) {
  change(1ms, What::kQueued, 100);
  change(2ms, What::kQueued, 300);
  change(4ms, What::kLeft, 100);
  change(5ms, What::kQueued, 50);
  queues->write(Time{10ms});
  // 1 ms with one, 2 ms with two, 1 ms with one, 5 ms with two.
  EXPECT_EQ(row("VO"), "3 2 2 400 16000000");
  queues->write(Time{11ms});
  EXPECT_EQ(row("VO"), "3 2 2 400 18000000") << "they still wait";
}

TEST_F(StationQueuesTest, TellsDropsByTheirCauses) {
  change(1ms, What::kQueued, 100);
  change(1ms, What::kQueued, 100);
  change(1ms, What::kRefused, 100, hal::Verdict::kQueueFull);
  change(1ms, What::kRefused, 100, hal::Verdict::kQueueFull);
  change(2ms, What::kDropped, 100, hal::Verdict::kQueueDelay);
  queues->write(Time{2ms});
  EXPECT_EQ(drops(), "queue delay 1, queue full 2");
  EXPECT_EQ(row("VO"), "2 1 2 200 2000000");
}

TEST_F(StationQueuesTest, DoesNotCountTogetherWhatMadeRoomForAnother) {
  for (int i = 0; i < 2; ++i) change(1ms, What::kQueued, 100);
  change(2ms, What::kQueued, 150);
  change(2ms, What::kDropped, 100, hal::Verdict::kQueueFull);
  change(2ms, What::kQueued, 100);
  change(2ms, What::kDropped, 100, hal::Verdict::kQueueFull);
  queues->write(Time{2ms});
  EXPECT_EQ(row("VO"), "4 2 2 250 2000000");
}

TEST_F(StationQueuesTest, CountsTogetherWhatIsDroppedLater) {
  for (int i = 0; i < 3; ++i) change(1ms, What::kQueued, 100);
  change(2ms, What::kDropped, 100, hal::Verdict::kQueueDelay);
  change(2ms, What::kLeft, 100);
  queues->write(Time{2ms});
  EXPECT_EQ(row("VO"), "3 1 3 300 3000000");
}

TEST_F(StationQueuesTest, NamesTheQueueOfAStationWithoutQos) {
  category.reset();
  change(1ms, What::kQueued, 100);
  change(1ms, What::kLeft, 100);
  queues->write(Time{2ms});
  EXPECT_EQ(row("all"), "1 0 1 100 0");
}

}  // namespace
}  // namespace results::record
