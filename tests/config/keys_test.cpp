#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "hal/files/config/document.h"
#include "hal/files/config/errors.h"
#include "hal/files/description/body_section.h"
#include "hal/files/description/key_describer.h"
#include "hal/robot/agent/robot_file.h"
#include "results/campaign/campaign_file.h"
#include "sim/scenario/radio_section.h"
#include "sim/scenario/scenario.h"

/// Every key of every kind of file is described, and the examples of the descriptions are true.
namespace hal::files::config {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

const fs::path kConfig = CONFIG_DIR, kTests = TESTS_DIR;

void read_scenario(files::config::Mapping in) { sim::scenario::read_scenario(in, "a.yaml"); }
void read_campaign(files::config::Mapping in) { results::campaign::read_campaign(in, "a.yaml"); }
void read_hardware(files::config::Mapping in) { robot::agent::RobotFile::read(in); }
void read_robot(files::config::Mapping in) { files::description::read_robot(in); }
void read_mote(files::config::Mapping in) { files::description::read_mote(in); }
void read_radio(files::config::Mapping in) { sim::scenario::read_radio(in); }

template <class File>
void describe(files::description::Fields& io) {
  using sim::scenario::keys_of;
  File file;
  keys_of(io, file);
}

/// A kind of file with files in which its examples may be put, each in at least one of them.
struct Kind {
  std::string name;
  void (*read)(files::config::Mapping);
  void (*keys)(files::description::Fields&);
  std::vector<fs::path> files;

  std::vector<files::config::KeyDescription> described() const {
    files::description::KeyDescriber describer;
    keys(describer);
    return describer.keys();
  }
};

const std::vector<Kind> kKinds = {
    {"scenario",
     read_scenario,
     describe<sim::scenario::Scenario>,
     {kConfig / "scenarios/case_study.yaml", kTests / "config/stations.yaml",
      kTests / "config/random_stations.yaml", kTests / "config/networks.yaml",
      kTests / "config/scenario_with_inertia.yaml",
      kConfig / "scenarios/anthocnet_base_field.yaml"}},
    {"campaign",
     read_campaign,
     describe<results::campaign::CampaignFile>,
     {kConfig / "campaigns/sensitivity.yaml", kConfig / "campaigns/phases.yaml",
      kTests / "config/plain_campaign.yaml", kTests / "config/sampled_campaign.yaml"}},
    {"hardware",
     read_hardware,
     describe<robot::agent::RobotFile>,
     {kConfig / "hardware/robotino.yaml", kConfig / "hardware/tmc200.yaml",
      kConfig / "hardware/mote.yaml", kTests / "config/hardware_with_inertia.yaml"}},
    {"robot",
     read_robot,
     describe<node::devices::RobotDescription>,
     {kConfig / "robots/robertino.yaml", kTests / "config/robot_with_inertia.yaml"}},
    {"mote", read_mote, describe<node::devices::MoteDescription>, {kConfig / "robots/mote.yaml"}},
    {"radio",
     read_radio,
     describe<sim::radio::RadioConfig>,
     {kConfig / "radios/ieee80211b.yaml", kConfig / "radios/mobility_framework.yaml",
      kConfig / "radios/ieee80211g.yaml", kConfig / "radios/ieee80211n.yaml",
      kConfig / "radios/ieee80211ac.yaml", kConfig / "radios/ieee80211ax.yaml",
      kConfig / "radios/disk.yaml", kConfig / "radios/ideal.yaml"}}};

/// Mistakes of a file with overrides.
Lines mistakes(const Kind& kind, const fs::path& file, const Lines& overrides) {
  try {
    files::config::Document document = files::config::Document::load(file, overrides);
    kind.read(document.root());
    document.finish();
  } catch (const files::config::ConfigErrors& errors) {
    return errors.messages();
  }
  return {};
}

class Keys : public testing::TestWithParam<Kind> {};

TEST_P(Keys, HaveAMeaningThatIsASentenceAndAnExample) {
  for (const files::config::KeyDescription& key : GetParam().described()) {
    EXPECT_FALSE(key.meaning.empty()) << key.path;
    EXPECT_TRUE(key.meaning.ends_with('.')) << key.path << ": " << key.meaning;
    const bool has_keys = key.form.kind == files::config::Form::Kind::kMapping;
    EXPECT_TRUE(has_keys || !key.example.empty()) << key.path << " has no example";
  }
}

/// Reads a key by the call that its form stands for.
void read_as(files::config::Mapping& in, const files::config::Key& key,
             const files::config::Form& form) {
  switch (form.kind) {
    case files::config::Form::Kind::kNumber:
      in.number(key, form.unit, form.range);
      break;
    case files::config::Form::Kind::kWhole:
      in.integer(key, form.low, form.high);
      break;
    case files::config::Form::Kind::kFlag:
      in.flag(key, false);
      break;
    case files::config::Form::Kind::kText:
      in.text(key);
      break;
    case files::config::Form::Kind::kVector:
      form.size == 2 ? (void)in.vec2(key, form.unit, form.range)
                     : (void)in.vec3(key, form.unit, form.range);
      break;
    case files::config::Form::Kind::kNumbers:  // of parameters of controllers only
      break;
    case files::config::Form::Kind::kTexts:
      in.texts(key);
      break;
    case files::config::Form::Kind::kMapping:
      in.mapping(key);
      break;
    case files::config::Form::Kind::kMappings:
      in.mappings(key);
      break;
    case files::config::Form::Kind::kChoice:
      EXPECT_NE(std::find(form.options.begin(), form.options.end(), key.example),
                form.options.end());
      break;
  }
}

TEST_P(Keys, HaveExamplesOfTheirFormAndRange) {
  const fs::path empty = fs::path(testing::TempDir()) / ("empty_" + std::to_string(::getpid()));
  std::ofstream(empty) << "{}\n";
  for (const files::config::KeyDescription& key : GetParam().described()) {
    if (key.example.empty()) continue;
    files::config::Document document =
        files::config::Document::load(empty, {"example=" + key.example});
    files::config::Mapping root = document.root();
    read_as(root, {"example", "Of a test.", key.example}, key.form);
    EXPECT_NO_THROW(document.finish()) << key.path << ": " << key.example;
  }
  fs::remove(empty);
}

/// The path with the name of a group for NAME.
std::string named(std::string path, const std::string& name) {
  const std::size_t at = path.find("NAME");
  return at == std::string::npos ? path : path.replace(at, 4, name);
}

/// A way to give a key its example: in a file, for a group, with values of the keys it depends on.
struct Way {
  fs::path file;
  std::string group;
  std::optional<std::size_t> value;  ///< Of each condition; none: those of the file.
};

/// What the command line must say.
Lines overrides_for(const files::config::KeyDescription& key,
                    const std::vector<files::config::KeyDescription>& all, const Way& way) {
  Lines overrides;
  for (const files::config::KeyDescription& outer : all) {
    const bool holds = key.path == outer.path || key.path.starts_with(outer.path + ".");
    for (const files::config::Condition& condition : outer.conditions) {
      if (!holds || condition.presence || !way.value) continue;
      overrides.push_back(named(condition.path, way.group) + "=" +
                          condition.values.at(*way.value % condition.values.size()));
    }
  }
  std::string example = key.example;
  for (auto at = example.find("NAME"); at != std::string::npos; at = example.find("NAME")) {
    example.replace(at, 4, way.group == "motes" ? "m" : "r");
  }
  overrides.push_back(named(key.path, way.group) + "=" + example);
  return overrides;
}

/// Whether one of the kind's files accepts the example in one of those ways.
testing::AssertionResult is_accepted(const Kind& kind, const files::config::KeyDescription& key,
                                     const std::vector<files::config::KeyDescription>& all) {
  constexpr std::array<std::optional<std::size_t>, 3> kValues = {std::nullopt, 0, 1};
  Lines found;
  for (const fs::path& file : kind.files) {
    for (const char* group : {"motes", "robots"}) {
      for (const auto value : kValues) {
        const Lines last = mistakes(kind, file, overrides_for(key, all, {file, group, value}));
        if (last.empty()) return testing::AssertionSuccess();
        found.insert(found.end(), last.begin(), last.end());
      }
    }
  }
  testing::AssertionResult failure = testing::AssertionFailure();
  for (const std::string& line : found) failure << line << "\n";
  return failure;
}

TEST_P(Keys, HaveExamplesThatTheReaderAcceptsInAFile) {
  const auto keys = GetParam().described();
  for (const files::config::KeyDescription& key : keys) {
    const bool in_list = key.path.find("[]") != std::string::npos;  // its list's example has it
    if (in_list || key.example.empty()) continue;
    EXPECT_TRUE(is_accepted(GetParam(), key, keys)) << key.path << ": " << key.example;
  }
}

/// The description of a key at a path in which names stand for NAME; null: there is none.
const KeyDescription* description_at(const std::vector<KeyDescription>& all,
                                     const std::string& path) {
  const auto found = std::ranges::find(all, path, &KeyDescription::path);
  return found == all.end() ? nullptr : &*found;
}

/// Paths of keys that stand in a mapping and are not described. @param path  of the mapping.
void find_unknown(files::config::Mapping in, const std::string& path,
                  const std::vector<KeyDescription>& all, Lines& unknown) {
  const std::string prefix = path.empty() ? "" : path + ".";
  const bool has_keys = path.empty() || std::ranges::any_of(all, [&](const KeyDescription& key) {
                          return key.path.starts_with(prefix);
                        });
  if (!has_keys) return;  // its values have a form of their own
  for (const std::string& name : in.keys()) {
    const KeyDescription* key = description_at(all, prefix + name);
    if (key == nullptr) key = description_at(all, prefix + "NAME");
    if (key == nullptr) {
      unknown.push_back(in.place(name) + ": " + prefix + name);
    } else if (key->form.kind == Form::Kind::kMapping && !in.has_scalar(name)) {
      find_unknown(in.within(name), key->path, all, unknown);
    } else if (key->form.kind == Form::Kind::kMappings) {
      for (files::config::Mapping& item : in.items(name))
        find_unknown(item, key->path + "[]", all, unknown);
    }
  }
}

/// What readers take without a description would be seen here.
TEST_P(Keys, OfFilesThatAreReadAreDescribed) {
  const std::vector<KeyDescription> all = GetParam().described();
  for (const fs::path& file : GetParam().files) {
    Lines unknown;
    find_unknown(files::config::Document::load(file, {}).root(), "", all, unknown);
    EXPECT_EQ(unknown, Lines{}) << file;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Keys, testing::ValuesIn(kKinds),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace hal::files::config
