#include "sim/core/fingerprint.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
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

TEST(Fingerprint, RowsTellTheAgentAndSecondApart) {
  const Feed a = value(Part::kAir, 1, Time{1s}, 0.1);
  Fingerprint one, two;
  for (Fingerprint* f : {&one, &two}) {
    a(*f);
    value(Part::kAir, 1, Time{3s}, 0.3)(*f);
  }
  value(Part::kBodies, 4, Time{2500ms}, 0.5)(one);
  value(Part::kBodies, 4, Time{2500ms}, 0.25)(two);
  const auto left = one.rows(), right = two.rows();
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
