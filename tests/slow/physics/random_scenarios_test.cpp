#include <gtest/gtest.h>

#include "tests/unit/sim/physics/random_scenario.h"

namespace sim::physics::test {
namespace {

constexpr std::uint64_t kParts = 20;
constexpr std::uint64_t kScenariosInAPart = 100;

class RandomScenarios : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Parts, RandomScenarios, testing::Range<std::uint64_t>(0, kParts));

TEST_P(RandomScenarios, NothingIsLostAndNothingSinksIn) {
  const std::uint64_t first = 1 + GetParam() * kScenariosInAPart;
  for (std::uint64_t seed = first; seed < first + kScenariosInAPart; ++seed) {
    SCOPED_TRACE(seed);
    RandomScenario(seed).run();
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace sim::physics::test
