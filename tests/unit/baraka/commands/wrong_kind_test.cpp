#include "baraka/commands/wrong_kind.h"

#include <gtest/gtest.h>

#include "hal/files/config/errors.h"
#include "tests/unit/hal/files/config/files.h"

namespace baraka::commands {
namespace {

using hal::files::config::ConfigErrors;
using hal::files::config::Lines;

class WrongKind : public hal::files::config::Files {
 protected:
  /// What is told of a file in which a command finds the mistake "wrong".
  Lines told(const std::string& kind, const std::filesystem::path& file) {
    return messages([&] {
      with_file_of(kind, {file.string()}, []() -> int { throw ConfigErrors({"wrong"}); });
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

TEST_F(WrongKind, IsToldOfWhatIsIncluded) {
  write("radio.yaml", "version: 1\nprofile: disk\nrange: 100 m\n");
  write("mote.yaml", "version: 1\nmodel: cube\nsize: [5 cm, 5 cm, 5 cm]\nmass: 50 g\n");
  write("campaign.yaml", "version: 1\nscenario: a.yaml\nreplications: 5\n");
  const auto scenario = write("s.yaml",
                              "version: 1\n"
                              "include: campaign.yaml\n"
                              "radio: {include: mote.yaml}\n"
                              "agents:\n"
                              "  right: {mote: {include: mote.yaml}}\n"
                              "  wrong: {robot: {include: radio.yaml}}\n"
                              "end: []\n");
  EXPECT_EQ(told("scenario", scenario),
            (Lines{"s.yaml:2:10: include: 'campaign.yaml' is a campaign file, not a scenario; "
                   "`baraka campaign FILE` runs it",
                   "s.yaml:3:18: radio.include: 'mote.yaml' is a mote file, not a radio; scenarios "
                   "include it: mote: {include: FILE}",
                   "s.yaml:6:28: agents.wrong.robot.include: 'radio.yaml' is a radio file, not a "
                   "robot; scenarios include it: radio: {include: FILE}"}));
  const auto hardware = write("h.yaml",
                              "version: 1\nagent: {name: r0}\nradio: {include: part.yaml}\n"
                              "robot: {include: mote.yaml}\n");
  write("part.yaml", "port: 7300\n");
  EXPECT_EQ(told("hardware", hardware),
            (Lines{"h.yaml:4:18: robot.include: 'mote.yaml' is a mote file, not a robot; scenarios "
                   "include it: mote: {include: FILE}"}));
}

TEST_F(WrongKind, OfIncludesIsJudgedWithTheCommandLine) {
  write("radio.yaml", "version: 1\nprofile: disk\nrange: 100 m\n");
  write("mote.yaml", "version: 1\nmodel: cube\nsize: [5 cm, 5 cm, 5 cm]\nmass: 50 g\n");
  const auto file =
      write("s.yaml", "version: 1\nradio: {include: mote.yaml}\nagents: {}\nend: []\n");
  const auto told_with = [&](const std::string& included) {
    return messages([&] {
      with_file_of("scenario", {file.string(), {}, {"radio.include=" + included}},
                   []() -> int { throw ConfigErrors({"wrong"}); });
    });
  };
  EXPECT_EQ(told_with("radio.yaml"), Lines{"wrong"});
  EXPECT_EQ(told_with("s.yaml"),
            (Lines{"--set radio.include: 's.yaml' is a scenario file, not a radio; "
                   "`baraka run FILE` runs it"}));
  EXPECT_EQ(told_with("nowhere.yaml"), Lines{"wrong"});
}

TEST_F(WrongKind, IsNotSaidOfAnIncludedPartThatMayBeOfEither) {
  write("part.yaml", "version: 1\n");
  EXPECT_EQ(told("scenario", write("s.yaml",
                                   "version: 1\nagents: {include: part.yaml}\n"
                                   "radio: {include: part.yaml}\nend: []\n")),
            Lines{"wrong"});
}

TEST_F(WrongKind, ChangesNothingWhereNothingIsWrong) {
  EXPECT_EQ(with_file_of("scenario", {"nowhere.yaml"}, [] { return 3; }), 3);
  EXPECT_THROW(with_file_of("scenario", {"nowhere.yaml"},
                            []() -> int { throw std::runtime_error("no disk"); }),
               std::runtime_error);
}

}  // namespace
}  // namespace baraka::commands
