#include "sim/core/fingerprint.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using sim::Fingerprint;
using sim::Part;

using Feed = std::function<void(Fingerprint&)>;

std::uint64_t total(const std::vector<Feed>& feeds) {
  Fingerprint fingerprint;
  for (const Feed& feed : feeds) feed(fingerprint);
  return fingerprint.total();
}

Feed value(Part part, int agent, Time at, double v) {
  return [=](Fingerprint& f) { f.at(part, AgentId{static_cast<std::uint16_t>(agent)}, at).add(v); };
}

TEST(Fingerprint, EqualFeedsGiveEqualTotals) {
  const std::vector<Feed> feeds{value(Part::kAir, 1, Time{1s}, 0.1),
                                value(Part::kBodies, 2, Time{2s}, 0.2)};
  EXPECT_EQ(total(feeds), total(feeds));
}

TEST(Fingerprint, EveryIngredientAndTheOrderOfAnAgentsValuesCount) {
  const Feed a = value(Part::kAir, 1, Time{1s}, 0.1);
  const Feed b = value(Part::kAir, 1, Time{1s}, 0.2);
  std::set<std::uint64_t> totals{
      total({a, b}),
      total({b, a}),
      total({a}),
      total({a, value(Part::kAir, 1, Time{1s}, 0.2 + 5e-17)}),  // one bit
      total({a, value(Part::kAir, 1, Time{1s + 1ns}, 0.2)}),
      total({a, value(Part::kAir, 2, Time{1s}, 0.2)}),
      total({a, value(Part::kRouting, 1, Time{1s}, 0.2)}),
  };
  EXPECT_EQ(totals.size(), 7u);
}

/// The rows that a fingerprint hands over.
std::vector<Fingerprint::Row> rows(const std::vector<Feed>& feeds) {
  std::vector<Fingerprint::Row> rows;
  Fingerprint fingerprint([&rows](const Fingerprint::Row& row) { rows.push_back(row); });
  for (const Feed& feed : feeds) feed(fingerprint);
  fingerprint.finish();
  return rows;
}

TEST(Fingerprint, RowsTellTheAgentAndSecondApart) {
  const Feed a = value(Part::kAir, 1, Time{1s}, 0.1);
  const Feed z = value(Part::kAir, 1, Time{3s}, 0.3);
  const auto left = rows({a, z, value(Part::kBodies, 4, Time{2500ms}, 0.5)});
  const auto right = rows({a, z, value(Part::kBodies, 4, Time{2500ms}, 0.25)});
  ASSERT_EQ(left.size(), right.size());
  int different = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (left[i].hash == right[i].hash) continue;
    ++different;
    EXPECT_EQ(left[i].agent, AgentId{4});
    EXPECT_EQ(left[i].second, 2);
    EXPECT_EQ(left[i].part, Part::kBodies);
  }
  EXPECT_EQ(different, 1);
}

/// "second part agent", "+" for a hash and "-" for none.
std::string places(const std::vector<Feed>& feeds) {
  std::string text;
  for (const auto& row : rows(feeds)) {
    text += fmt::format("{}{} {} {}{}", text.empty() ? "" : ", ", row.second, sim::name(row.part),
                        row.agent.value, row.hash ? "+" : "-");
  }
  return text;
}

TEST(Fingerprint, ARowComesOnlyWhereASecondIsNotLikeTheOneBefore) {
  std::vector<Feed> feeds;
  for (int second = 0; second < 30; ++second) {
    feeds.push_back(value(Part::kBodies, 1, Time{second * 1s + 100ms}, 0.5));
    feeds.push_back(value(Part::kBodies, 2, Time{second * 1s + 100ms}, second == 20 ? 0.6 : 0.5));
  }
  EXPECT_EQ(places(feeds), "0 bodies 1+, 0 bodies 2+, 20 bodies 2+, 21 bodies 2+");
  // The same a little later in the second is not the same.
  feeds.push_back(value(Part::kBodies, 1, Time{30s + 101ms}, 0.5));
  EXPECT_TRUE(places(feeds).ends_with("21 bodies 2+, 30 bodies 1+, 30 bodies 2-")) << places(feeds);
}

TEST(Fingerprint, WhatStopsBeingObservedHasARowAndSilenceHasNone) {
  EXPECT_EQ(places({value(Part::kAir, 3, Time{1s}, 1), value(Part::kAir, 3, Time{2s}, 1),
                    value(Part::kAir, 3, Time{50s}, 1)}),
            "1 air 3+, 3 air 3-, 50 air 3+");
  EXPECT_EQ(places({}), "");
}

TEST(Fingerprint, SecondsAreHandedOverAsTheyEndNotAtTheEndOfTheRun) {
  std::int64_t last = -1;
  Fingerprint fingerprint([&last](const Fingerprint::Row& row) { last = row.second; });
  for (int second = 0; second < 1000; ++second) {
    value(Part::kAir, 1, Time{second * 1s}, second)(fingerprint);
    EXPECT_EQ(last, std::max<std::int64_t>(second - Fingerprint::kLateness, 0) - 1) << second;
  }
}

TEST(Fingerprint, TotalsDoNotDependOnWhatWasHandedOver) {
  Fingerprint whole, handed_over;
  for (int second = 0; second < 100; ++second) {
    for (Fingerprint* f : {&whole, &handed_over})
      value(Part::kAir, 1, Time{second * 1s}, second)(*f);
    if (second == 60) {
      EXPECT_EQ(handed_over.total(), whole.total());
    }
  }
  handed_over.finish();
  EXPECT_EQ(handed_over.total(), whole.total());
}

TEST(Fingerprint, AnEventMayBeToldLateByTheLongestLatency) {
  const Feed now = value(Part::kAir, 1, Time{25s + 999ms}, 1);
  const Feed late = value(Part::kExchange, 1, Time{16s}, 2);
  EXPECT_EQ(total({now, late}), total({late, now}));
  // What comes later still is kept, in the oldest second that is open.
  const Feed too_late = value(Part::kExchange, 1, Time{3s}, 2);
  EXPECT_NE(total({now, too_late}), total({now}));
  EXPECT_EQ(places({now, too_late}), "15 exchange 1+, 16 exchange 1-, 25 air 1+");
}

TEST(Fingerprint, ObservationsMayAlternateBetweenSeconds) {
  constexpr int kSeconds = 8;  // all of them open at once
  const auto air = [](int second) { return value(Part::kAir, 1, Time{second * 1s}, second); };
  const auto exchange = [](int second) {
    return value(Part::kExchange, 2, Time{second * 1s + 999'999'999ns}, second);
  };
  std::vector<Feed> one_by_one, alternating;
  for (int i = 0; i < kSeconds; ++i) one_by_one.push_back(air(i));
  for (int i = 0; i < kSeconds; ++i) one_by_one.push_back(exchange(i));
  for (int i = 0; i < kSeconds; ++i) {
    alternating.push_back(air(i));
    alternating.push_back(exchange(kSeconds - 1 - i));
  }
  EXPECT_EQ(total(one_by_one), total(alternating));
  EXPECT_EQ(rows(one_by_one), rows(alternating));
}

TEST(Hash, BytesOfEveryLengthDiffer) {
  std::set<std::uint64_t> hashes;
  const std::vector<char> zeros(40, 0);
  for (std::size_t size = 0; size <= zeros.size(); ++size) {
    sim::Hash hash;
    hash.add_bytes(zeros.data(), size);
    hashes.insert(hash.value());
  }
  EXPECT_EQ(hashes.size(), zeros.size() + 1);
}

}  // namespace
