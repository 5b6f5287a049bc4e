// What holds for every law of propagation that files can name, with its defaults.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sim/radio/channel/path_losses.h"

namespace sim::radio::test {
namespace {

std::vector<PathLossConfig> named_laws() {
  return []<std::size_t... kIndex>(std::index_sequence<kIndex...> /*all*/) {
    return std::vector<PathLossConfig>{std::variant_alternative_t<kIndex, PathLossConfig>{}...};
  }
  (std::make_index_sequence<kNamedLaws>{});
}

TEST(Laws, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const PathLossConfig& law : named_laws())
    EXPECT_TRUE(names.insert(model_of(law)).second) << model_of(law);
}

TEST(Laws, LeaveNoMoreOfAPowerThanTheirGainAndReachAdmit) {
  constexpr hal::Milliwatts kSent{100}, kLeast{1e-8};
  const PropagationConfig air;
  for (const PathLossConfig& law : named_laws()) {
    const auto loss = path_loss(law, air, *kFlatGround);
    ASSERT_NE(loss, nullptr) << model_of(law);
    for (double metres = 0.25; metres < 1e5; metres *= 1.5) {
      const bool is_beyond = metres > loss->reach(kSent, kLeast);
      const hal::Milliwatts most = loss->most_gain() * (is_beyond ? kLeast : kSent);
      for (std::uint64_t name = 2; name < 20; ++name) {
        const Site from(hal::Vec3{}, 1, 1), to(hal::Vec3{metres, 0, 0}, 1, name);
        EXPECT_LE(loss->after(kSent, Path(from, to)), most) << model_of(law) << ' ' << metres;
      }
    }
  }
}

TEST(Laws, OfDistanceReachSomewhereAndNotEverywhere) {
  const PropagationConfig air;
  for (const PathLossConfig& law : named_laws()) {
    const double reach =
        path_loss(law, air, *kFlatGround)->reach(hal::Milliwatts{100}, hal::Milliwatts{1e-8});
    EXPECT_GT(reach, 0) << model_of(law);
    // Measured losses may be any at any distance.
    if (is_law_of_distance(law) && !std::holds_alternative<MeasuredConfig>(law)) {
      EXPECT_LT(reach, 1e6) << model_of(law);
    }
  }
}

}  // namespace
}  // namespace sim::radio::test
