#include "results/record/relay_counts.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "sim/radio/mac/mac_sap.h"
#include "tests/unit/results/record/test_run.h"

namespace results::record {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;

constexpr AgentId kAccessPoint{4}, kSource{1}, kDestination{2};

class RelayCountsTest : public testing::Test {
 protected:
  RelayCountsTest()
      : folder_(testing::UnitTest::GetInstance()->current_test_info()->name()),
        database_(folder_.file(), Database::Mode::kCreate) {
    create_tables(database_);
    counts.emplace(database_);
  }

  void queue(hal::Duration at, AgentId to = kDestination) {
    sim::radio::MacRequest request;
    request.destination = to;
    counts->on_relay_queued(Time{at}, {kAccessPoint, kSource, request});
  }
  void end(hal::Duration at, const sim::radio::MsduEnd& how, AgentId to = kDestination,
           AgentId from = kSource) {
    sim::radio::MacRequest request;
    request.destination = to;
    counts->on_msdu_end(Time{at}, {kAccessPoint, from, request}, how);
  }
  std::string relays() {
    return ask(
        "SELECT IFNULL(GROUP_CONCAT(destination || ' ' || verdict || ' ' || count, ', '), '') FROM"
        " (SELECT * FROM relays WHERE agent = 4 AND source = 1 ORDER BY destination, verdict)");
  }
  std::string queue_of_destination() {
    return ask(
        "SELECT frames || ' ' || waiting || ' ' || most || ' ' || waited_ns FROM relay_queues"
        " WHERE agent = 4 AND destination = 2");
  }

  std::string ask(const std::string& sql) {
    Statement query(database_, sql);
    return query.next() ? query.text(0) : "none";
  }
  test::Folder folder_;
  Database database_;

 public:
  std::optional<RelayCounts> counts;  ///< Ends before its database.
};

TEST_F(RelayCountsTest, SaysHowManyWaitedAndHowLong) {
  queue(1ns);
  queue(3ns);
  end(6ns, {});
  end(6ns, {.verdict = hal::Verdict::kQueueFull, .has_waited = false});
  counts->write(Time{10ns});
  EXPECT_EQ(relays(), "2 delivered 1, 2 queue full 1, 2 waiting 1");
  EXPECT_EQ(queue_of_destination(), "2 1 2 12") << "5 ns of the first, 7 of the second so far";
  counts->write(Time{20ns});
  EXPECT_EQ(queue_of_destination(), "2 1 2 22") << "though nothing happened";
  end(21ns, {.verdict = hal::Verdict::kRetryLimit});
  counts->write(Time{30ns});
  EXPECT_EQ(relays(), "2 delivered 1, 2 queue full 1, 2 retry limit 1");
  EXPECT_EQ(queue_of_destination(), "2 0 2 23");
}

TEST_F(RelayCountsTest, TellsGroupsAndTheWireFromWhatWasDelivered) {
  queue(1ns, hal::kEveryone);
  end(2ns, {}, hal::kEveryone);
  end(3ns, {.has_waited = false, .went_over_wire = true});
  end(4ns, {}, kDestination, kAccessPoint);  // its own
  end(4ns, {}, kAccessPoint);                // for it
  end(5ns, {.verdict = hal::Verdict::kNoRoute, .has_waited = false}, kAccessPoint);
  counts->write(Time{10ns});
  EXPECT_EQ(relays(), "2 over the wire 1, 4 no route 1, 65535 transmitted 1");
  EXPECT_EQ(queue_of_destination(), "none");
}

}  // namespace
}  // namespace results::record
