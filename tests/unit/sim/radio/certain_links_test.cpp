#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "hal/types/random.h"
#include "sim/radio/channel/links.h"

namespace sim::radio::test {
namespace {

class CertainLinksTest : public testing::Test {
 protected:
  void insert(StationIndex receiver, Tick until) {
    links.insert({.receiver = receiver, .most = 1}, until);
    expected[receiver] = until;
  }
  /// Those that renew() asks about are certain for `longer` ticks from `now`, or gone.
  std::set<StationIndex> renew(Tick now, Tick longer, const std::set<StationIndex>& gone = {}) {
    std::set<StationIndex> asked;
    links.renew(now, [&](const AskedLink& link, Tick& until) {
      asked.insert(link.receiver);
      until = now + longer;
      return !gone.contains(link.receiver);
    });
    return asked;
  }
  /// The same, of the map.
  std::set<StationIndex> renew_expected(Tick now, Tick longer,
                                        const std::set<StationIndex>& gone = {}) {
    std::set<StationIndex> asked;
    for (auto one = expected.begin(); one != expected.end();) {
      if (one->second > now) {
        ++one;
        continue;
      }
      asked.insert(one->first);
      one->second = now + longer;
      one = gone.contains(one->first) ? expected.erase(one) : std::next(one);
    }
    return asked;
  }
  std::vector<StationIndex> receivers() const {
    std::vector<StationIndex> found;
    for (const AskedLink& link : links.all()) found.push_back(link.receiver);
    return found;
  }
  std::vector<StationIndex> expected_receivers() const {
    std::vector<StationIndex> found;
    for (const auto& [receiver, until] : expected) found.push_back(receiver);
    return found;
  }

  CertainLinks<AskedLink> links;
  std::map<StationIndex, Tick> expected;
};

TEST_F(CertainLinksTest, AsksOnceALinkIsNoLongerCertain) {
  insert(7, 5);
  EXPECT_TRUE(renew(4, 10).empty());
  EXPECT_EQ(renew(5, 10), (std::set<StationIndex>{7}));
  EXPECT_TRUE(renew(14, 10).empty());
  EXPECT_EQ(renew(15, 10), (std::set<StationIndex>{7}));
}

TEST_F(CertainLinksTest, ForgetsThoseThatAreNoLongerWhatTheyWere) {
  for (StationIndex i = 0; i < 40; ++i) insert(i, static_cast<Tick>(i % 3));
  std::set<StationIndex> odd;
  for (StationIndex i = 1; i < 40; i += 2) odd.insert(i);
  EXPECT_EQ(renew(2, kForEver - 2, odd).size(), 40u) << "also those that move up";
  EXPECT_EQ(links.all().size(), 20u);
  for (const AskedLink& link : links.all()) EXPECT_EQ(link.receiver % 2, 0u);
}

TEST_F(CertainLinksTest, DoAsAMapWould) {
  hal::RandomStream random(1, "links");
  for (Tick now = 0; now < 2000; ++now) {
    const auto receiver = static_cast<StationIndex>(random.below(100));
    if (random.uniform() < 0.3) {
      links.erase(receiver);
      expected.erase(receiver);
    } else if (!expected.contains(receiver)) {
      insert(receiver, now + static_cast<Tick>(random.below(300)));
    }
    std::set<StationIndex> gone;
    while (gone.size() < 5) gone.insert(static_cast<StationIndex>(random.below(100)));
    const Tick longer = 1 + static_cast<Tick>(random.below(200));
    ASSERT_EQ(renew(now, longer, gone), renew_expected(now, longer, gone)) << now;
    ASSERT_EQ(receivers(), expected_receivers()) << now;
  }
  EXPECT_GT(links.all().size(), 32u) << "more than are compared at once";
}

}  // namespace
}  // namespace sim::radio::test
