#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <vector>

#include "baraka/commands/exec_command.h"
#include "baraka/commands/topic_command.h"
#include "baraka/commands/topic_domain.h"
#include "baraka/commands/topic_from.h"
#include "baraka/main/commands.h"
#include "gateway/process/command_line.h"
#include "gateway/process/domains.h"

namespace baraka::main {
namespace {

using commands::TopicOptions;
using gateway::process::seconds;
using gateway::process::whole_number;

constexpr std::int64_t kMostSamples = 1'000'000'000;
constexpr double kLeastTimeout = 1e-3;  // s

using Held = std::shared_ptr<TopicOptions>;

/// One of the commands that look at a topic that is there now.
Subcommand looking(CLI::App* command, const Held& held, int (*act)(const TopicOptions&)) {
  command
      ->add_option("--domain", held->domain,
                   "DDS domain; default: BARAKA_DOMAIN, else the one in which a run or daemon "
                   "publishes its topics, else ROS_DOMAIN_ID, else 1")
      ->transform(whole_number(0, gateway::process::kLastDomain));
  return {command, [held, act] {
            held->domain = commands::topic_domain(held->domain);
            return act(*held);
          }};
}

/// Adds what names the topic, and how long to wait for it.
void with_topic(CLI::App* command, const Held& held) {
  command->add_option("TOPIC", held->topic, "As listed, or as in ROS 2: /clock")->required();
  command->add_option("--timeout", held->timeout, "Longest wait for the topic and a sample")
      ->transform(seconds(kLeastTimeout));
}

void with_count(CLI::App* command, const Held& held) {
  command->add_option("--count", held->count, "End after this number of samples")
      ->transform(whole_number(1, kMostSamples));
}

Subcommand add_topics_from(CLI::App& topic, const Held& held) {
  CLI::App* from =
      topic.add_subcommand("from", "What a recording holds, as `topics:` of a scenario");
  from->add_option("FILE", held->file,
                   "MCAP, rosbag2 (its folder, metadata.yaml or .db3), pcap or pcapng")
      ->required();
  return {from, [held] { return commands::topics_from(*held); }};
}

}  // namespace

Subcommand add_exec(CLI::App& app) {
  const auto held = std::make_shared<commands::ExecOptions>();
  commands::ExecOptions& options = *held;
  CLI::App* exec = app.add_subcommand(
      "exec", "Run a command inside an agent of a run under way: baraka exec r0 -- ping r1");
  exec->add_option("AGENT", options.agent, "An agent with a network")->required();
  exec->add_option("--run", options.run, "Folder of its results; default: the only run under way");
  exec->add_option("COMMAND", options.command, "After --; default: a shell");
  return {exec, [held]() -> int { commands::exec_inside(*held); }};
}

std::vector<Subcommand> add_topic(CLI::App& app) {
  CLI::App* topic =
      app.add_subcommand("topic", "Inspect the topics of a run, a robot or a recording");
  topic->require_subcommand(1);
  const auto held = std::make_shared<TopicOptions>();
  CLI::App* list = topic->add_subcommand("list", "All topics");
  CLI::App* info = topic->add_subcommand("info", "Type and endpoints");
  CLI::App* echo = topic->add_subcommand("echo", "Samples");
  CLI::App* rate = topic->add_subcommand("hz", "Rate of samples");
  CLI::App* bandwidth = topic->add_subcommand("bw", "Bandwidth of samples");
  std::vector<Subcommand> all{
      looking(list, held, commands::list_topics), looking(info, held, commands::topic_info),
      looking(echo, held, commands::echo_topic), looking(rate, held, commands::topic_rate),
      looking(bandwidth, held, commands::topic_bandwidth)};
  for (CLI::App* one : {info, echo, rate, bandwidth}) with_topic(one, held);
  for (CLI::App* one : {echo, rate, bandwidth}) with_count(one, held);
  all.push_back(add_topics_from(*topic, held));
  return all;
}

}  // namespace baraka::main
