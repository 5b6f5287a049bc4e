#include "results/campaign/slurm_section.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "hal/files/config/document.h"
#include "hal/files/description/field_io.h"

namespace results::campaign {
namespace {

using namespace std::chrono_literals;

/// What a file with this text says.
SlurmSettings settings_in(const std::string& text) {
  const std::string file = testing::TempDir() + "/slurm_" + std::to_string(::getpid()) + ".yaml";
  std::ofstream(file) << text;
  auto document = hal::files::config::Document::load(file);
  std::filesystem::remove(file);
  hal::files::config::Mapping root = document.root();
  SlurmSettings settings;
  hal::files::description::FieldReader io(root);
  slurm_key(io, settings);
  root.finish();
  document.finish();
  return settings;
}

std::string mistakes_in(const std::string& text) {
  try {
    (void)settings_in(text);
  } catch (const hal::files::config::ConfigErrors& errors) {
    return errors.what();
  }
  return "";
}

TEST(SlurmSettings, ArgumentsThatTheEngineNeedsAreRefused) {
  for (const char* argument : {"--array=1", "-a1", "-J", "--wrap=x", "--no-requeue", "-W", "mem"}) {
    EXPECT_NE(refusal(argument), "") << argument;
  }
  for (const char* argument : {"--account=a", "-A", "--mem=1G", "--hold", "--nice", "-n1"}) {
    EXPECT_EQ(refusal(argument), "") << argument;
  }
}

TEST(SlurmSettings, WithoutTheKeyTheClusterDecides) {
  const SlurmSettings settings = settings_in("{}");
  EXPECT_EQ(settings.partition, "");
  EXPECT_EQ(settings.time, std::nullopt);
  EXPECT_EQ(settings.poll, 5s);
  EXPECT_EQ(settings.settle, 60s);
  EXPECT_TRUE(settings.arguments.empty());
}

TEST(SlurmSettings, EachKeySaysWhatItSays) {
  const SlurmSettings settings = settings_in(
      "slurm: {partition: long, time: 2 h, poll: 1 s, settle: 0 s, arguments: [--mem=1G, -Ax]}");
  EXPECT_EQ(settings.partition, "long");
  EXPECT_EQ(settings.time, 2h);
  EXPECT_EQ(settings.poll, 1s);
  EXPECT_EQ(settings.settle, 0s);
  EXPECT_EQ(settings.arguments, (std::vector<std::string>{"--mem=1G", "-Ax"}));
}

TEST(SlurmSettings, MistakesAreNamedWithTheirPlaces) {
  const std::string mistakes =
      mistakes_in("slurm:\n  time: 0 s\n  arguments: [--mem=1G, --array=3]\n  partitoin: long\n");
  EXPECT_NE(mistakes.find(":2:9: slurm.time: "), std::string::npos) << mistakes;
  EXPECT_NE(mistakes.find("'--array=3' is set by the engine"), std::string::npos) << mistakes;
  EXPECT_NE(mistakes.find("did you mean 'partition'"), std::string::npos) << mistakes;
}

}  // namespace
}  // namespace results::campaign
