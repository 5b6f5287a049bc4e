#include "results/record/replay_log.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "results/record/hexadecimal.h"
#include "tests/unit/results/record/test_run.h"

namespace results::record::test {
namespace {

using namespace std::chrono_literals;

ReplayLog replay_log_of(const std::string& pace, const std::string& sql) {
  const Folder folder("replay");
  make_result(folder.path(),
              "INSERT INTO run VALUES ('pace', '" + pace + "'), ('ended_ns', 1000);" + sql);
  return read_replay_log(folder.path());
}

std::string refusal(const std::string& pace, const std::string& sql) {
  try {
    replay_log_of(pace, sql);
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

constexpr const char* kArrivals =
    "INSERT INTO arrivals VALUES (5, 'cmd_vel of r0', '00ff7a'), (5, 'b', '');";

TEST(ReplayLogs, TurnsAndArrivalsComeBackInTheirOrder) {
  const ReplayLog log = replay_log_of(
      "realtime:2", std::string("INSERT INTO turns VALUES (7, 1, 0, 1);") + kArrivals);
  EXPECT_TRUE(log.in_real_time);
  EXPECT_EQ(log.ended_at, hal::Time{1us});
  ASSERT_EQ(log.turns.size(), 1u);
  EXPECT_EQ(log.turns[0], (sim::agents::Turn{hal::Time{7ns}, 1, false, true}));
  const std::vector<sim::OutsideArrival> arrivals{
      {hal::Time{5ns}, "cmd_vel of r0", {0, 0xff, 0x7a}}, {hal::Time{5ns}, "b", {}}};
  EXPECT_EQ(log.arrivals, arrivals);
}

TEST(ReplayLogs, LockStepIsRepeatedFromItsRecordIfSomethingCameFromOutside) {
  EXPECT_FALSE(replay_log_of("lockstep", kArrivals).in_real_time);
  EXPECT_NE(refusal("lockstep", "").find("nothing came into it from outside"), std::string::npos);
  EXPECT_NE(refusal("repeated", kArrivals).find("itself repeated"), std::string::npos);
}

TEST(ReplayLogs, WhatIsDamagedIsNamed) {
  const auto arrival = [](const char* values) {
    return refusal("realtime", std::string("INSERT INTO arrivals VALUES ") + values);
  };
  EXPECT_NE(arrival("(5, 'a', '0g')").find("table arrivals, row 1: bytes is '0g', not hexadecimal"),
            std::string::npos);
  EXPECT_NE(arrival("(5, 'a', '012')").find("'012', not hexadecimal"), std::string::npos);
  EXPECT_NE(arrival("(9, 'a', ''), (5, 'a', '')")
                .find("table arrivals, row 2: at_ns is 5, before 9 ns of the row above"),
            std::string::npos);
  EXPECT_NE(
      arrival("(1001, 'a', '')").find("row 1: at_ns is 1001, not a whole number from 0 to 1000"),
      std::string::npos);
}

TEST(Hexadecimal, EveryByteComesBack) {
  std::vector<std::uint8_t> bytes(256);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i);
  EXPECT_EQ(from_hexadecimal(to_hexadecimal(bytes)), bytes);
  EXPECT_EQ(to_hexadecimal(std::vector<std::uint8_t>{0x0a, 0xf5}), "0af5");
  for (const char* wrong : {"0", "-1", "+1", " 1", "0x"}) {
    EXPECT_EQ(from_hexadecimal(wrong), std::nullopt) << wrong;
  }
}

}  // namespace
}  // namespace results::record::test
