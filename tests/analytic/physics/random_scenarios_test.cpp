#include <gtest/gtest.h>

#include "tests/unit/sim/physics/random_scenario.h"

namespace sim::physics::test {
namespace {

/// A sample of the 2,000 in tests/slow.
TEST(RandomScenarios, NothingIsLostAndNothingSinksIn) {
  int with_contacts = 0;
  for (std::uint64_t seed = 1; seed <= 60 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    RandomScenario scenario(seed);
    scenario.run();
    with_contacts += scenario.had_contacts();
  }
  EXPECT_GT(with_contacts, 30);
}

}  // namespace
}  // namespace sim::physics::test
