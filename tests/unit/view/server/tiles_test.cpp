#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>
#include <stdexcept>

#include "results/record/controller_log.h"
#include "tests/unit/view/server/small_result.h"
#include "view/server/tile.h"

namespace view::server::test {
namespace {

class Tiles : public testing::Test {
 protected:
  Tiles() : result(testing::UnitTest::GetInstance()->current_test_info()->name()) {}

  json ask(const std::string& path) {
    if (!run) run.emplace(result.path());
    return test::ask(*run, path);
  }
  /// Of a tile: "poses/14/0".
  json columns(const std::string& path) { return ask(path).at("columns"); }

  SmallResult result;
  std::optional<server::Run> run;
};

TEST(Span, CoversWhatItsLevelAndIndexSay) {
  EXPECT_EQ(Span::of(4, 3)->from(), 3 * 4096);
  EXPECT_EQ(Span::of(4, 3)->to(), 4 * 4096);
  EXPECT_FALSE(Span::of(3, 0));
  EXPECT_FALSE(Span::of(18, 0));
  EXPECT_FALSE(Span::of(17, -1));
  EXPECT_FALSE(Span::of(17, 1 << 11));  // 2^62 ns
  EXPECT_EQ(bin_of(*Span::of(4, 1), 4096), 0U);
  EXPECT_EQ(bin_of(*Span::of(4, 1), 8191), 63U);
}

TEST_F(Tiles, PosesBeginWithWhereEachOneWasBefore) {
  for (int i = 1; i <= 20; ++i) {
    result.recorder->on_body(Time{i * 100ms}, AgentId{3}, {.x = 50 + i * 0.1, .theta = 0.5});
  }
  result.end(3'000'000'000);
  const json first = columns("poses/14/0");
  ASSERT_EQ(first["at"].size(), 23U);  // at the start, three; then its own
  EXPECT_EQ(first["agent"][2], 3);
  EXPECT_EQ(first["x"][2], 50.0);
  EXPECT_EQ(first["at"][3], 100'000'000);
  // [1073741824, 2147483648): the row at 1.0 s, which is before, and those from 1.1 s to 2 s.
  const json later = ask("poses/10/1");
  EXPECT_TRUE(later["complete"]);
  EXPECT_EQ(later["columns"]["agent"], json({1, 2, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3}));
  EXPECT_EQ(later["columns"]["at"][2], 1'000'000'000);
  EXPECT_EQ(later["columns"]["at"][3], 1'100'000'000);
  EXPECT_EQ(later["columns"]["x"][3], 50 + 11 * 0.1);
  EXPECT_EQ(later["from"], 1073741824);
  EXPECT_EQ(later["to"], 2147483648);
  EXPECT_EQ(later["until"], 3'000'000'000);
}

TEST_F(Tiles, MovablesBeginWithWhereEachOneWasBefore) {
  result.end(3'000'000'000);
  result.execute(
      "INSERT INTO movables VALUES (0, 'crate', 'box', 1, 2, 3, 4), (1, 'ball', 'sphere', 1, 1, 1, "
      "1); INSERT INTO movable_poses VALUES (0, 0, 5, 6, 0.5, 1, 0, 0, 0), (1, 0, 7, 8, 0.5, 1, 0, "
      "0, 0), (0, 1000000000, 5.5, 6, 0.5, 0, 0, 0, 1), (0, 1500000000, 5.75, 6, 0.5, 1, 0, 0, 0)");
  const json later = ask("movables/10/1");  // [1073741824, 2147483648)
  EXPECT_TRUE(later["complete"]);
  EXPECT_EQ(later["columns"]["movable"], json({0, 1, 0}));
  EXPECT_EQ(later["columns"]["at"], json({1'000'000'000, 0, 1'500'000'000}));
  EXPECT_EQ(later["columns"]["x"], json({5.5, 7.0, 5.75}));
  EXPECT_EQ(later["columns"]["qz"], json({1.0, 0.0, 0.0}));
  const json world = ask("world")["movables"];
  EXPECT_EQ(world[1]["name"], "ball");
  EXPECT_EQ(world[0]["form"], "box");
  EXPECT_EQ(world[0]["length_z"], 3.0);
}

TEST_F(Tiles, TooManyMovablesAreTheFirstOfEachPart) {
  result.end(3'000'000'000);
  result.execute(
      "WITH RECURSIVE n(i) AS (SELECT 0 UNION ALL SELECT i + 1 FROM n WHERE i < 20001) INSERT INTO "
      "movable_poses SELECT 0, i * 100000, i, 0, 0, 1, 0, 0, 0 FROM n");
  const json all = ask("movables/11/0");  // 8.6 s: 20,002 rows in 2 s
  EXPECT_FALSE(all["complete"]);
  EXPECT_EQ(all["columns"]["at"].size(), 15U);  // parts of 0.134 s
  EXPECT_EQ(all["columns"]["at"][1], 134'300'000);
}

TEST_F(Tiles, TooManyPosesAreTheFirstOfEachPart) {
  result.end(25'000'000'000);
  result.execute(
      "WITH RECURSIVE n(i) AS (SELECT 0 UNION ALL SELECT i + 1 FROM n WHERE i < 24999)"
      " INSERT INTO poses SELECT 3, i * 1000000, i, 0, 0 FROM n");
  const json tile = ask("poses/12/0");  // 68.7 s, parts of 1.07 s
  EXPECT_FALSE(tile["complete"]);
  ASSERT_EQ(tile["columns"]["at"].size(), 2 + 24U);
  EXPECT_EQ(tile["columns"]["x"][3], 1074);  // the first at or after 1073.7 ms
  EXPECT_TRUE(ask("poses/11/0")["complete"]);
}

TEST_F(Tiles, FramesHaveHowTheyEndedAtEveryRadio) {
  auto frame = frame_of(7, AgentId{1}, AgentId{2});
  frame.sequence = 5;
  frame.air_length = 800;
  result.recorder->on_frame_start(Time{10ms}, frame);
  result.recorder->on_sinr(12.5);
  result.recorder->on_reception(Time{11ms}, frame, AgentId{2}, Verdict::kDelivered, -60.5);
  result.recorder->on_reception(Time{11ms}, frame, AgentId{3}, Verdict::kCollision, -70);
  result.end(1'000'000'000);
  const json tile = ask("frames/14/0");
  EXPECT_TRUE(tile["complete"]);
  const json& rows = tile["columns"];
  EXPECT_EQ(rows["transmitter"], json({1}));
  EXPECT_EQ(rows["number"], json({7}));
  EXPECT_EQ(rows["at"], json({10'000'000}));
  EXPECT_EQ(rows["receiver"], json({2}));
  EXPECT_EQ(rows["sequence"], json({5}));
  EXPECT_EQ(rows["bits"], json({800}));
  EXPECT_EQ(rows["airtime"], json({1'000'000}));
  const json& ends = rows["ends"][0];
  ASSERT_EQ(ends.size(), 2U);
  EXPECT_EQ(ends[0][0], 2);
  EXPECT_EQ(ends[0][1], 11'000'000);
  EXPECT_EQ(tile["verdicts"][ends[0][2].get<std::size_t>()], "delivered");
  EXPECT_EQ(ends[0][3], -60.5);
  EXPECT_EQ(ends[0][4], 12.5);
  EXPECT_EQ(tile["verdicts"][ends[1][2].get<std::size_t>()], "collision");
  EXPECT_EQ(ends[1][4], nullptr);
  // It begins in one tile, ends in the next: [2^21, 2 * 2^21) is [2.1 ms, 4.2 ms).
  EXPECT_EQ(columns("frames/7/4")["ends"][0].size(), 2U);  // [8.4, 10.5) ms
  EXPECT_EQ(columns("frames/7/5")["at"].size(), 0U);
}

TEST_F(Tiles, TooManyFramesAreCountedByClassWithTheirLosses) {
  result.end(100'000'000'000);
  // Every 10 ms one of agent 1 for agent 2, and each tenth is lost there; agent 3 hears none.
  result.execute(
      "WITH RECURSIVE n(i) AS (SELECT 0 UNION ALL SELECT i + 1 FROM n WHERE i < 9999)"
      " INSERT INTO frames SELECT (1 << 48) + i, i * 10000000, CASE i % 4 WHEN 0 THEN 'rts' ELSE "
      "'unicast' END, 1, 2, i, 0, 100, 1000000, 0, NULL, NULL, NULL, NULL, NULL, NULL"
      ", 0, 1000000, NULL, NULL, NULL, NULL, NULL, NULL, NULL, 1, NULL FROM n;"
      "INSERT INTO frame_ends SELECT frame, a.agent, at_ns + 1000000, CASE WHEN a.agent = 3 OR "
      "sequence % 10 = 0 THEN 'noise' ELSE 'delivered' END, -80, 3 FROM frames, agents a WHERE "
      "a.agent > 1");
  const auto sum = [](const json& counts) {
    std::int64_t total = 0;
    for (const json& one : counts) total += one.get<std::int64_t>();
    return total;
  };
  // 100 s in bins of 8.6 s (from kept seconds); 68.7 s in bins of 1.07 s; each is a sum of smaller.
  for (const auto& [path, frames] : {std::pair{"frames/13/0", 10000}, {"frames/12/0", 6872}}) {
    const json bins = ask(path).at("bins");
    EXPECT_EQ(bins["classes"], json({"rts", "unicast"}));
    EXPECT_EQ(sum(bins["counts"][0]) + sum(bins["counts"][1]), frames) << path;
    EXPECT_EQ(sum(bins["counts"][0]), frames / 4) << path;
    EXPECT_EQ(sum(bins["lost"]), (frames + 9) / 10) << path;
  }
  // Bins of one tile are tiles of two levels below.
  const json bins = ask("frames/12/0").at("bins");
  const std::size_t rows = columns("frames/10/3")["at"].size();
  EXPECT_EQ(bins["counts"][0][3].get<std::size_t>() + bins["counts"][1][3].get<std::size_t>(),
            rows);
}

TEST_F(Tiles, MessagesHaveTheirDeliveries) {
  const hal::Message message{
      .source = AgentId{1}, .destination = AgentId{2}, .id = 4, .topic = "help", .payload = {1, 2}};
  result.recorder->on_message_sent(Time{1ms}, message);
  result.recorder->on_fate(Time{2ms}, AgentId{1}, 4, hal::Fate::kHandedOver);
  result.recorder->on_message_end(Time{4ms}, AgentId{2}, AgentId{1}, 4, Verdict::kDelivered);
  result.recorder->on_message_delivered(Time{4ms}, AgentId{2}, message, 2);
  result.end(100'000'000'000);
  const json rows = columns("messages/14/0");
  EXPECT_EQ(rows["sender"], json({1}));
  EXPECT_EQ(rows["id"], json({4}));
  EXPECT_EQ(rows["topic"], json({"help"}));
  EXPECT_EQ(rows["fate"], json({"handed over"}));
  EXPECT_EQ(rows["fate_at"], json({2'000'000}));
  EXPECT_EQ(rows["verdict"], json({"delivered"}));
  EXPECT_EQ(rows["deliveries"], json({{{2, 4'000'000, 3'000'000, 2}}}));
  // Sent at most 60 s before: in the tile from 55.8 s to 56.9 s, not in that from 60.1 s on.
  EXPECT_EQ(columns("messages/10/52")["id"], json({4}));
  EXPECT_EQ(columns("messages/10/57")["id"].size(), 0U);
}

TEST_F(Tiles, TooManyMessagesAreCountedByTopic) {
  result.end(10'000'000'000);
  result.execute(
      "WITH RECURSIVE n(i) AS (SELECT 0 UNION ALL SELECT i + 1 FROM n WHERE i < 5999)"
      " INSERT INTO messages (sender, id, destination, topic, bytes, sent_ns, priority) SELECT 1 + "
      "i % 2, i, "
      "3, CASE i % 3 WHEN 0 THEN 'a' ELSE 'b' END, 1, i * 1000000, 0 FROM n");
  const json bins = ask("messages/12/0").at("bins");
  EXPECT_EQ(bins["topics"], json({"a", "b"}));
  EXPECT_EQ(bins["counts"][0][0], 358);  // of 1074 in the first 1.07 s
  EXPECT_TRUE(ask("messages/10/0")["complete"]);
}

TEST_F(Tiles, StatesBeginWithTheLastBefore) {
  result.recorder->on_state(Time{1s}, AgentId{1}, "IDLE");
  result.recorder->on_state(Time{2s}, AgentId{1}, "WAIT");
  result.recorder->on_state(Time{2s}, AgentId{1}, "GO");
  result.recorder->on_state(Time{20s}, AgentId{1}, "DONE");
  result.end(30'000'000'000);
  EXPECT_EQ(columns("states/14/0")["state"], json({"IDLE", "WAIT", "GO", "DONE"}));
  const json later = columns("states/11/2");  // [17.2, 25.8) s
  EXPECT_EQ(later["state"], json({"GO", "DONE"}));
  EXPECT_EQ(later["at"], json({2'000'000'000, 20'000'000'000}));
}

TEST_F(Tiles, EventsTellWhatHappenedInWords) {
  result.recorder->on_body_lost({AgentId{3}, sim::physics::BodyLoss::kTipped, Time{1230ms}});
  result.recorder->on_discovery(Time{2s}, AgentId{1}, {"help", AgentId{2}, 962181ns, true});
  result.recorder->on_arrival({Time{3s}, "cmd_vel of r0", {}});
  result.end(30'000'000'000);
  const json rows = columns("events/14/0");
  EXPECT_EQ(rows["kind"], json({"lost body", "discovery", "arrival"}));
  EXPECT_EQ(rows["agent"], json({3, 1, nullptr}));
  EXPECT_EQ(rows["text"][1], "help to m1: found after 0.962 ms");
}

TEST_F(Tiles, ReadingsAndQueuesBeginWithTheLastHoweverLongAgo) {
  result.end(4000'000'000'000);
  result.execute(
      "INSERT INTO readings VALUES (3, 1000000000, 'bumper', '0'), (3, 2000000000, 'infrared', "
      "'0.5 - 1e-3'), (3, 3000000000000, 'infrared', '- - -'), (3, 3000000000500, 'infrared', '1 2 "
      "3');"
      "INSERT INTO queues VALUES (1, 5, 2), (2, 6, 1), (1, 3000000000000, 0)");
  const json early = columns("readings/14/0");
  EXPECT_EQ(early["values"][1], json({0.5, nullptr, 0.001}));
  // The tile of 4 us that holds 3000 s and 500 ns.
  const std::int64_t index = 3000'000'000'500 / 4096;
  const json rows = columns("readings/4/" + std::to_string(index));
  EXPECT_EQ(rows["channel"], json({"bumper", "infrared", "infrared", "infrared"}));
  EXPECT_EQ(rows["at"][1], 2'000'000'000);
  const json queues = columns("queues/4/" + std::to_string(index + 1));
  EXPECT_EQ(queues["agent"], json({2, 1}));
  EXPECT_EQ(queues["frames"], json({1, 0}));
}

long most_memory() {  // KiB
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return used.ru_maxrss;
}

// A record of few rows may claim that it lasted for months.
TEST_F(Tiles, WhatIsKeptGrowsWithTheRowsNotWithTheTimes) {
  result.end(10'000'000'000'000'000);
  result.execute(
      "INSERT INTO queues VALUES (1, 0, 2), (2, 9999999999999999, 1), (1, 9999999999999999, 0);"
      "WITH RECURSIVE n(i) AS (SELECT 0 UNION ALL SELECT i + 1 FROM n WHERE i < 23999)"
      " INSERT INTO frames SELECT (1 << 48) + i, i * 416666666666, 'ack', 1, 2, i, 0, 100,"
      " 1000000, 0, NULL, NULL, NULL, NULL, NULL, NULL"
      ", 0, 1000000, NULL, NULL, NULL, NULL, NULL, NULL, NULL, 1, NULL FROM n;"
      "INSERT INTO frame_ends SELECT frame, 2, at_ns, 'noise', -80, 3 FROM frames");
  [[maybe_unused]] const long before = most_memory();
  EXPECT_EQ(columns("queues/17/4")["frames"], json({2, 0, 1}));
  const json bins = ask("frames/17/0").at("bins");
  std::int64_t lost = 0;
  for (const json& one : bins["lost"]) lost += one.get<std::int64_t>();
  EXPECT_EQ(lost, 5405);      // 2^51 ns of them
#ifndef __SANITIZE_ADDRESS__  // which keeps what is freed
  EXPECT_LT(most_memory() - before, 100'000);
#endif
}

TEST_F(Tiles, RowsThatAreOutOfOrderAreNamed) {
  result.end(10'000'000'000);
  result.execute("INSERT INTO states VALUES (1, 5000000000, 'A'), (2, 1000000000, 'B')");
  try {
    (void)ask("states/10/1");
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(
        std::string(e.what()).find("run.sqlite: table states, row 2: at_ns is 1000000000, out of "
                                   "order"),
        std::string::npos)
        << e.what();
  }
}

TEST_F(Tiles, TheLogIsInTiles) {
  result.end(10'000'000'000);
  std::ofstream(result.path() / "run.log")
      << "[   1.000000000] info r0: hello: there\n[   1.500000000] warning record: one\ntwo\n"
      << "[   9.000000000] error m0: late\n[   9.5";
  const json rows = columns("log/14/0");
  EXPECT_EQ(rows["at"], json({1'000'000'000, 1'500'000'000, 9'000'000'000}));
  EXPECT_EQ(rows["level"], json({"info", "warning", "error"}));
  EXPECT_EQ(rows["source"], json({"r0", "record", "m0"}));
  EXPECT_EQ(rows["text"], json({"hello: there", "one\ntwo", "late"}));
  std::ofstream(result.path() / "run.log", std::ios::app) << "00000000] info m0: more\n";
  EXPECT_EQ(columns("log/11/1")["text"], json({"late", "more"}));
}

TEST_F(Tiles, SeriesAreValuesOrTheirRange) {
  for (int i = 0; i < 6000; ++i) {
    result.recorder->on_record(Time{i * 1ms}, AgentId{3}, "speed", i % 2 == 0 ? 1.0 : 3.0);
  }
  result.recorder->on_record(Time{7s}, AgentId{1}, "other", 7);
  result.end(10'000'000'000);
  const json series = ask("world").at("series");
  ASSERT_EQ(series.size(), 2U);
  EXPECT_EQ(series[0]["name"], "speed");
  EXPECT_EQ(series[0]["agent"], 3);
  const std::string speed = "series:" + series[0]["index"].dump() + "/";
  EXPECT_EQ(columns(speed + "10/0")["value"].size(), 1074U);
  const json tile = ask(speed + "12/0");
  EXPECT_FALSE(tile["complete"]);
  EXPECT_EQ(tile["bins"]["n"], 256);
  EXPECT_EQ(tile["bins"]["min"][0], 1.0);
  EXPECT_EQ(tile["bins"]["max"][0], 3.0);
  EXPECT_NEAR(tile["bins"]["mean"][0], 2.0, 0.01);
  EXPECT_EQ(tile["bins"]["mean"][100], nullptr);
  EXPECT_EQ(ask("series:12345/10/0"), json());
}

TEST_F(Tiles, SeriesOfControllersHaveTheUnitThatTheyDeclare) {
  result.recorder->find<results::record::ControllerLog>()->add_units(
      {{{"program", "speed"}, "m/s"}, {{"another", "other"}, "J"}});
  result.recorder->on_record(Time{1s}, AgentId{3}, "speed", 1);
  result.recorder->on_record(Time{1s}, AgentId{1}, "speed", 2);
  result.recorder->on_record(Time{1s}, AgentId{1}, "other", 3);
  result.end(2'000'000'000);
  const json series = ask("world").at("series");
  ASSERT_EQ(series.size(), 3U);
  EXPECT_EQ(series[0]["unit"], "m/s");
  EXPECT_EQ(series[1]["unit"], "m/s");
  EXPECT_EQ(series[2]["name"], "other");
  EXPECT_EQ(series[2]["unit"], "") << "of another controller";
}

TEST_F(Tiles, RoutesHaveTheirShareOfTheMessages) {
  result.end(10'000'000'000);
  // Weights 1 and 3: equation 1 gives a quarter and three quarters; then one way is gone.
  result.execute(
      "INSERT INTO routes VALUES (1, 10, 'help', 3, 2, 2, 500, 20.5, 1e-6, 1.0),"
      " (1, 20, 'help', 3, 3, 1, 400, 30, 1e-6, 3.0), (1, 30, 'help', 3, 2, NULL, NULL, NULL, NULL,"
      " NULL), (2, 40, 'help', 3, 3, 1, 1, 1, 1, 1)");
  const json rows = ask("routes/1").at("columns");
  EXPECT_EQ(rows["at"], json({10, 20, 20, 30, 30}));
  EXPECT_EQ(rows["next_hop"], json({2, 3, 2, 2, 3}));
  EXPECT_EQ(rows["probability"], json({1.0, 0.75, 0.25, nullptr, 1.0}));
  EXPECT_EQ(rows["removed"], json({false, false, false, true, false}));
  EXPECT_EQ(ask("routes/9"), json());
}

TEST_F(Tiles, TotalsAreTheCountersOfAnAgent) {
  const auto frame = frame_of(1, AgentId{1}, AgentId{2});
  result.recorder->on_frame_start(Time{1ms}, frame);
  result.recorder->on_reception(Time{2ms}, frame, AgentId{2}, Verdict::kDelivered, -60);
  result.recorder->on_reception(Time{2ms}, frame, AgentId{3}, Verdict::kNoise, -90);
  result.end(1'000'000'000);
  EXPECT_EQ(ask("totals/1")["frames_sent"], json({{"unicast", 1}}));
  EXPECT_EQ(ask("totals/2")["receptions"], json({{"delivered", 1}}));
  EXPECT_EQ(ask("totals/3")["overheard"], json({{"noise", 1}}));
}

TEST_F(Tiles, TotalsOfAnAccessPointAreOfWhatItPassesOnToo) {
  result.end(1'000'000'000);
  result.execute(
      "INSERT INTO relays VALUES (1, 2, 3, 'delivered', 4), (1, 2, 3, 'queue full', 5),"
      " (1, 3, 65535, 'transmitted', 6);"
      "INSERT INTO relay_queues VALUES (1, 3, 4, 2, 7, 1000)");
  const json totals = ask("totals/1");
  EXPECT_EQ(totals["relays"],
            json({{"r0: delivered", 4}, {"r0: queue full", 5}, {"everyone: transmitted", 6}}));
  EXPECT_EQ(totals["relay_queues"], json({{"r0: waiting", 2}, {"r0: most", 7}}));
  EXPECT_TRUE(ask("totals/2")["relays"].empty());
}

TEST_F(Tiles, TotalsHaveTheQueuesOfReceivers) {
  result.end(1'000'000'000);
  result.execute(
      "INSERT INTO station_queues VALUES (1, 3, 'BE', 9, 2, 7, 700, 1000), (1, 65535, 'VO', 3, 0, "
      "1,"
      " 100, 10); INSERT INTO station_queue_drops VALUES (1, 3, 'BE', 'queue delay', 5)");
  EXPECT_EQ(ask("totals/1")["station_queues"], json({{"everyone VO: most", 1},
                                                     {"everyone VO: waiting", 0},
                                                     {"r0 BE: most", 7},
                                                     {"r0 BE: queue delay", 5},
                                                     {"r0 BE: waiting", 2}}));
}

TEST_F(Tiles, TheWorldHasWhatTheRecordKnows) {
  result.recorder->on_start({{AgentId{1}, AgentId{2}}});
  result.recorder->on_body(Time{1s}, AgentId{3}, {.x = -20, .y = 30});
  result.end(2'000'000'000);
  const json world = ask("world");
  EXPECT_EQ(world["name"], "small");
  EXPECT_EQ(world["result"], "arrived");
  EXPECT_EQ(world["until"], 2'000'000'000);
  EXPECT_EQ(world["agents"][2]["name"], "r0");
  EXPECT_EQ(world["links"], json({{1, 2}}));
  EXPECT_EQ(world["walls"][0]["length_x"], 2.0);
  EXPECT_EQ(world["bounds"]["x0"], -20);
  EXPECT_EQ(world["bounds"]["x1"], 100);
}

// A reader would keep the recorder from making one plain file of it in the end.
TEST_F(Tiles, ARecordThatGrowsIsReadAndLeftAlone) {
  result.recorder->on_state(Time{1s}, AgentId{1}, "IDLE");
  result.recorder->commit();
  EXPECT_EQ(columns("states/14/0")["state"], json({"IDLE"}));
  EXPECT_EQ(ask("states/14/0")["until"], 1'000'000'000);
  result.recorder->on_state(Time{2s}, AgentId{1}, "DONE");
  result.recorder->commit();
  EXPECT_EQ(columns("states/14/0")["state"], json({"IDLE", "DONE"}));
  result.end(3'000'000'000);
  EXPECT_FALSE(std::filesystem::exists(result.path() / "run.sqlite-wal"));
  EXPECT_EQ(ask("states/14/0")["until"], 3'000'000'000);
}

TEST_F(Tiles, ThereIsNothingElse) {
  result.end(1'000'000'000);
  for (const char* path :
       {"", "/", "poses", "poses/14", "poses/14/0/", "poses/14/-1", "poses/014/0", "poses/3/0",
        "poses/18/0", "poses/17/99999999999999999999", "nothing/14/0", "series:/14/0",
        "series:x/14/0", "routes/0", "routes/01", "totals/99999999999", "../run.sqlite", "world/",
        "run.sqlite"}) {
    EXPECT_EQ(ask(path), json()) << path;
  }
}

}  // namespace
}  // namespace view::server::test
