#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <limits>

#include "gateway/runtime/check_parameters.h"
#include "gateway/runtime/controller_host.h"
#include "gateway/runtime/controller_options.h"
#include "gateway/runtime/plugin.h"
#include "tests/unit/gateway/runtime/one_agent.h"

namespace {

using namespace std::chrono_literals;
using gateway::runtime::check_parameters;
using gateway::runtime::read_parameters;
using hal::node::exchange::ParameterText;

constexpr double kNever = std::numeric_limits<double>::infinity();

class Idle : public hal::Controller {
 public:
  Idle(hal::Mote&, const hal::Parameters& parameters) { last_speed = parameters["speed"]; }
  inline static double last_speed = 0;
};

hal::ControllerKind idle() {
  return {.name = "idle",
          .parameters = {{"speed", "m/s", 0.5, 0, 2, "How fast."},
                         {"help_at", "s", kNever, 0, kNever, "When."}},
          .make_for_mote = hal::make_for_mote<Idle>};
}

TEST(CheckParameters, FindsNothingWrongWithGoodOnes) {
  EXPECT_TRUE(check_parameters(
                  idle(), {{"speed", "0.9 km/h", "a.yaml:1:2"}, {"help_at", "never", "a.yaml:2:2"}})
                  .empty());
}

TEST(StartUp, AParameterDeclaredInWhatIsNoUnitIsAMistakeOfTheController) {
  hal::ControllerKind kind = idle();
  kind.parameters = {{"count", "pieces", 0, 0, 9, "How many."}};
  EXPECT_EQ(check_parameters(kind, {{"count", "3", "a.yaml:1:2"}}),
            std::vector<std::string>{"a.yaml:1:2: count: idle declares it in 'pieces', which is no "
                                     "unit (\"1\" is that of a plain number)"});
}

hal::ControllerKind with_all_kinds() {
  hal::ControllerKind kind = idle();
  kind.parameters = {
      {.name = "mode", .default_value = "near", .meaning = "Whom.", .choices = {"near", "needy"}},
      {.name = "called", .default_value = "", .meaning = "How it is called."},
      {.name = "patrols", .default_value = false, .meaning = "Whether."},
      {.name = "way",
       .unit = "m",
       .default_value = std::vector<double>{1, 2},
       .low = -9,
       .high = 9,
       .meaning = "Where."},
      {.name = "friends", .default_value = std::vector<std::string>{}, .meaning = "Who."}};
  return kind;
}

ParameterText list(std::string name, std::vector<std::string> items) {
  return {std::move(name), "", "a.yaml:1:2", true, std::move(items)};
}

TEST(CheckParameters, ReadsTextsFlagsAndLists) {
  const hal::ControllerKind kind = with_all_kinds();
  const hal::Parameters defaults = read_parameters(kind, {});
  EXPECT_EQ(defaults.text("mode"), "near");
  EXPECT_FALSE(defaults.flag("patrols"));
  EXPECT_EQ(defaults.numbers("way"), (std::vector<double>{1, 2}));
  EXPECT_TRUE(defaults.texts("friends").empty());

  const std::vector<ParameterText> given = {{"mode", "needy", "a.yaml:1:2"},
                                            {"patrols", "true", "a.yaml:2:2"},
                                            list("way", {"30 cm", "-2 m", "0 m"}),
                                            list("friends", {"r1", "m*"})};
  ASSERT_EQ(check_parameters(kind, given), std::vector<std::string>{});
  const hal::Parameters parameters = read_parameters(kind, given);
  EXPECT_EQ(parameters.text("mode"), "needy");
  EXPECT_TRUE(parameters.flag("patrols"));
  EXPECT_EQ(parameters.numbers("way"), (std::vector<double>{0.3, -2, 0}));
  EXPECT_EQ(parameters.texts("friends"), (std::vector<std::string>{"r1", "m*"}));
}

TEST(CheckParameters, SaysWhatATextAFlagOrAListMustBe) {
  const hal::ControllerKind kind = with_all_kinds();
  const auto mistake = [&](const ParameterText& given) { return check_parameters(kind, {given}); };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(mistake({"mode", "nedy", "a.yaml:1:2"}),
            Lines{"a.yaml:1:2: mode: 'nedy' is not one of near, needy; did you mean 'needy'?"});
  EXPECT_EQ(mistake({"patrols", "yes", "a.yaml:1:2"}),
            Lines{"a.yaml:1:2: patrols: must be true or false, not 'yes'"});
  EXPECT_EQ(mistake({"way", "1 m", "a.yaml:1:2"}),
            Lines{"a.yaml:1:2: way: must be a list, each a number with its unit (m), not '1 m'"});
  EXPECT_EQ(mistake(list("way", {"1 m", "10 m"})),
            Lines{"a.yaml:1:2: way: item 2: 10 m is above the limit of 9 m"});
  EXPECT_EQ(mistake(list("mode", {"near"})),
            Lines{"a.yaml:1:2: mode: must be one of near, needy, not a list of 1"});
}

TEST(CheckParameters, RefusesTimesThatNoClockOfOursHolds) {
  hal::ControllerKind kind = idle();
  kind.parameters = {{"help_at", "s", kNever, 0, kNever, "When."},
                     {"rest", "ms", 0, -1e300, 1e300, "How long."}};
  const auto mistakes = check_parameters(
      kind, {{"help_at", "1e300 s", "a.yaml:1:2"}, {"rest", "-3e12 ms", "a.yaml:2:2"}});
  ASSERT_EQ(mistakes.size(), 2U);
  EXPECT_EQ(mistakes[0],
            "a.yaml:1:2: help_at: 1e300 s is above the limit of 1000000000 s; 'never' and 'none' "
            "are without end");
  EXPECT_EQ(mistakes[1], "a.yaml:2:2: rest: -3e12 ms is below the limit of -1000000000 s");
  EXPECT_TRUE(check_parameters(
                  kind, {{"help_at", "1e9 s", "a.yaml:1:2"}, {"rest", "1e12 ms", "a.yaml:2:2"}})
                  .empty());
  EXPECT_TRUE(check_parameters(kind, {{"help_at", "never", "a.yaml:1:2"}}).empty());
}

TEST(CheckParameters, NamesPlaceParameterAndMistakeOfEach) {
  const auto mistakes = check_parameters(idle(), {{"sped", "1 m/s", "a.yaml:1:2"},
                                                  {"speed", "3 m/s", "a.yaml:2:2"},
                                                  {"help_at", "5", "a.yaml:3:2"},
                                                  {"speed", "1 m/s", "a.yaml:4:2"}});
  ASSERT_EQ(mistakes.size(), 4U);
  EXPECT_EQ(mistakes[0], "a.yaml:1:2: sped: is not a parameter of idle; did you mean 'speed'?");
  EXPECT_EQ(mistakes[1].find("a.yaml:2:2: speed: "), 0U);
  EXPECT_NE(mistakes[1].find("2 m/s"), std::string::npos) << "names the limit: " << mistakes[1];
  EXPECT_EQ(mistakes[2].find("a.yaml:3:2: help_at: "), 0U);
  EXPECT_EQ(mistakes[3], "a.yaml:4:2: speed: already given at a.yaml:2:2");
}

TEST(ControllerHost, HandsParametersOverInSiUnitsWithDefaultsFilledIn) {
  auto session = tests::mote_session();
  ASSERT_TRUE(
      gateway::runtime::ControllerHost::create(idle(), tests::session_of(session)).has_value());
  EXPECT_EQ(Idle::last_speed, 0.5);
  session.parameters = {{"speed", "0.9 km/h", "a.yaml:1:2"}};
  ASSERT_TRUE(
      gateway::runtime::ControllerHost::create(idle(), tests::session_of(session)).has_value());
  EXPECT_EQ(Idle::last_speed, 0.25);
}

TEST(ControllerHost, RefusesToStartWithWrongParameters) {
  auto session = tests::mote_session();
  session.parameters = {{"sped", "1 m/s", "a.yaml:1:2"}, {"hlp", "1 m/s", "a.yaml:2:2"}};
  const auto host = gateway::runtime::ControllerHost::create(idle(), tests::session_of(session));
  ASSERT_FALSE(host.has_value());
  EXPECT_EQ(host.error().code, hal::Errc::kInvalidArgument);
  EXPECT_EQ(host.error().message,
            "a.yaml:1:2: sped: is not a parameter of idle; did you mean 'speed'?\n"
            "a.yaml:2:2: hlp: is not a parameter of idle");
}

gateway::runtime::ParsedOptions parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "idle");
  return gateway::runtime::parse_controller_options(static_cast<int>(arguments.size()),
                                                    arguments.data(), idle());
}

TEST(ControllerOptions, AreReadFromTheCommandLine) {
  const auto parsed = parse({"--agents", "m*", "--agents", "r0", "--domain", "7", "--name", "p",
                             "--stay", "--wait", "500 ms"});
  ASSERT_TRUE(parsed.options.has_value());
  EXPECT_EQ(parsed.options->agents, (std::vector<std::string>{"m*", "r0"}));
  EXPECT_EQ(parsed.options->domain, 7);
  EXPECT_EQ(parsed.options->name, "p");
  EXPECT_TRUE(parsed.options->stay);
  EXPECT_EQ(parsed.options->wait, 500ms);
}

TEST(ControllerOptions, DefaultToTheEnvironmentsDomainAndThirtySeconds) {
  const auto parsed = parse({"--agents", "r0"});
  ASSERT_TRUE(parsed.options.has_value());
  EXPECT_FALSE(parsed.options->domain.has_value());
  EXPECT_TRUE(parsed.options->name.empty());
  EXPECT_FALSE(parsed.options->stay);
  EXPECT_EQ(parsed.options->wait, 30s);
}

TEST(ControllerOptions, TakePlainSecondsAndForEverAsWait) {
  EXPECT_EQ(parse({"--agents", "r0", "--wait", "5"}).options.value().wait, 5s);
  EXPECT_EQ(parse({"--agents", "r0", "--wait", "none"}).options.value().wait, hal::Duration::max());
}

TEST(ControllerOptions, EndTheProgramWithStatusTwoAfterAMistake) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(parse({}).exit_status, 2) << "no agents";
  EXPECT_EQ(parse({"--agents", "r0", "--domain", "233"}).exit_status, 2);
  EXPECT_EQ(parse({"--agents", "r0", "--wait", "soon"}).exit_status, 2);
  EXPECT_EQ(parse({"--agents", "r0", "--agnets", "r1"}).exit_status, 2);
  EXPECT_FALSE(parse({}).options.has_value());
  EXPECT_NE(testing::internal::GetCapturedStderr().find("--wait"), std::string::npos);
}

TEST(ControllerOptions, HelpListsTheParametersAndIsNoMistake) {
  testing::internal::CaptureStdout();
  const auto parsed = parse({"--help"});
  const std::string help = testing::internal::GetCapturedStdout();
  EXPECT_FALSE(parsed.options.has_value());
  EXPECT_EQ(parsed.exit_status, 0);
  EXPECT_NE(help.find("How fast. (0 m/s .. 2 m/s; default 0.5 m/s)"), std::string::npos) << help;
  EXPECT_NE(help.find("default never"), std::string::npos) << help;
}

TEST(LoadPlugin, NamesTheFoldersItLookedIn) {
  const auto kind = gateway::runtime::load_plugin("nobody", {"/nowhere", "/elsewhere"});
  ASSERT_FALSE(kind.has_value());
  EXPECT_EQ(kind.error().code, hal::Errc::kNotAvailable);
  EXPECT_EQ(kind.error().message,
            "'nobody' is not a known controller: looked for nobody.so in /nowhere, /elsewhere; "
            "BARAKA_CONTROLLER_PATH adds folders");
}

TEST(LoadPlugin, TellsOfALinkThatLeadsNowhereAndDoesNotSuggestIt) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "baraka_dangling";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  std::filesystem::create_symlink("/nowhere/x.so", folder / "vanished.so");
  for (const char* const name : {"vanished", "vanishde"}) {
    const auto kind = gateway::runtime::load_plugin(name, {folder});
    ASSERT_FALSE(kind.has_value());
    EXPECT_EQ(kind.error().code, hal::Errc::kNotAvailable);
    EXPECT_EQ(kind.error().message.find("did you mean"), std::string::npos);
    const auto link =
        kind.error().message.find("vanished.so is a link to a file that is not there");
    EXPECT_EQ(link != std::string::npos, name == std::string("vanished")) << kind.error().message;
  }
  std::filesystem::remove_all(folder);
}

TEST(LoadPlugin, TakesNoPathForAName) {
  const auto kind = gateway::runtime::load_plugin("../evil", {"/tmp"});
  ASSERT_FALSE(kind.has_value());
  EXPECT_EQ(kind.error().code, hal::Errc::kInvalidArgument);
}

TEST(LoadPlugin, SaysSoWhenTheFileIsNoLibrary) {
  const std::string folder = testing::TempDir();
  std::ofstream(folder + "text.so") << "no library";
  const auto kind = gateway::runtime::load_plugin("text", {folder});
  ASSERT_FALSE(kind.has_value());
  EXPECT_EQ(kind.error().code, hal::Errc::kProtocol);
  EXPECT_NE(kind.error().message.find("text.so cannot be loaded: "), std::string::npos);
}

TEST(LoadPlugin, GivesTheControllerAndTheSameOneAgain) {
  const auto kind = gateway::runtime::load_plugin("wanderer", {"/nowhere", BIN_DIR});
  ASSERT_TRUE(kind.has_value()) << kind.error().message;
  EXPECT_EQ((*kind)->name, "wanderer");
  EXPECT_EQ(gateway::runtime::load_plugin("wanderer", {BIN_DIR}).value(), *kind);
  auto host =
      gateway::runtime::ControllerHost::create(**kind, tests::session_of(tests::robot_session()));
  EXPECT_TRUE(host.has_value()) << "its controllers can be made";
}

TEST(LoadPlugin, RefusesOtherHeadersAndLibrariesThatAreNoController) {
  const auto folders = gateway::runtime::controller_folders();  // beside this test
  const auto foreign = gateway::runtime::load_plugin("foreign", folders);
  ASSERT_FALSE(foreign.has_value());
  EXPECT_EQ(foreign.error().code, hal::Errc::kProtocol);
  EXPECT_NE(foreign.error().message.find("was built with other headers"), std::string::npos);
  const auto mute = gateway::runtime::load_plugin("mute", folders);
  ASSERT_FALSE(mute.has_value());
  EXPECT_EQ(mute.error().code, hal::Errc::kInvalidArgument);
  EXPECT_NE(mute.error().message.find("mute.so is no controller"), std::string::npos);
}

TEST(ControllerFolders, AreThoseOfTheEnvironmentThenTheExecutables) {
  ASSERT_EQ(setenv("BARAKA_CONTROLLER_PATH", "/a::/b", 1), 0);
  const auto folders = gateway::runtime::controller_folders();
  unsetenv("BARAKA_CONTROLLER_PATH");
  ASSERT_EQ(folders.size(), 3U);
  EXPECT_EQ(folders[0], "/a");
  EXPECT_EQ(folders[1], "/b");
  EXPECT_TRUE(std::filesystem::exists(folders[2] / "unit_gateway_runtime_test"));
}

}  // namespace
