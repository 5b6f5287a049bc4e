#include "gateway/commands/wrong_kind.h"

#include <gtest/gtest.h>

#include "hal/config/errors.h"
#include "tests/unit/hal/config/files.h"

namespace gateway {
namespace {

using hal::config::ConfigErrors;
using hal::config::Lines;

class WrongKind : public hal::config::Files {
 protected:
  /// What is told of a file in which a command finds the mistake "wrong".
  Lines told(const std::string& kind, const std::filesystem::path& file) {
    return messages([&] {
      with_file_of(kind, file.string(), {}, []() -> int { throw ConfigErrors({"wrong"}); });
    });
  }
  Lines shipped(const std::string& kind, const std::string& file) {
    return told(kind, std::filesystem::path(CONFIG_DIR) / file);
  }
};

TEST_F(WrongKind, IsToldWithWhatTakesTheFile) {
  const std::string folder = CONFIG_DIR;
  EXPECT_EQ(shipped("scenario", "campaigns/phases.yaml"),
            (Lines{folder + "/campaigns/phases.yaml: is a campaign file, not a scenario; `baraka "
                            "campaign FILE` runs it"}));
  EXPECT_EQ(shipped("scenario", "robots/youbot.yaml"),
            (Lines{folder + "/robots/youbot.yaml: is a robot file, not a scenario; scenarios "
                            "include it: robot: {include: FILE}"}));
  EXPECT_EQ(shipped("scenario", "hardware/mote.yaml"),
            (Lines{folder + "/hardware/mote.yaml: is a hardware file, not a scenario; "
                            "`baraka-agentd FILE` serves it"}));
  EXPECT_EQ(shipped("campaign", "scenarios/wanderer.yaml"),
            (Lines{folder + "/scenarios/wanderer.yaml: is a scenario file, not a campaign; `baraka "
                            "run FILE` runs it"}));
  EXPECT_EQ(told("scenario", write("empty.yaml", "# nothing\n")),
            (Lines{"empty.yaml: is empty: it has no key of a scenario; `baraka describe scenario` "
                   "shows one"}));
}

TEST_F(WrongKind, IsNotSaidOfTheRightOneNorOfWhatMayBeEither) {
  EXPECT_EQ(shipped("scenario", "scenarios/wanderer.yaml"), Lines{"wrong"});
  EXPECT_EQ(told("scenario", write("a.yaml", "version: 1\n")), Lines{"wrong"});
  EXPECT_EQ(told("scenario", folder_ / "no.yaml"), Lines{"wrong"});
}

TEST_F(WrongKind, ChangesNothingWhereNothingIsWrong) {
  EXPECT_EQ(with_file_of("scenario", "nowhere.yaml", {}, [] { return 3; }), 3);
  EXPECT_THROW(with_file_of("scenario", "nowhere.yaml", {},
                            []() -> int { throw std::runtime_error("no disk"); }),
               std::runtime_error);
}

}  // namespace
}  // namespace gateway
