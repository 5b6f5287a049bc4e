#include "programs/topics/plan.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>

#include "hal/types/overloaded.h"

namespace programs::topics {
namespace {

using nlohmann::json;

json json_of(const hal::TopicQos& qos) {
  using Qos = hal::TopicQos;
  json out = {{"reliable", qos.reliability == Qos::Reliability::kReliable},
              {"transient_local", qos.durability == Qos::Durability::kTransientLocal}};
  if (qos.depth) out["history"] = *qos.depth;
  if (qos.deadline) out["deadline_ns"] = qos.deadline->count();
  return out;
}

hal::TopicQos qos_of(const json& in) {
  using Qos = hal::TopicQos;
  Qos qos;
  qos.reliability =
      in.at("reliable").get<bool>() ? Qos::Reliability::kReliable : Qos::Reliability::kBestEffort;
  qos.durability = in.at("transient_local").get<bool>() ? Qos::Durability::kTransientLocal
                                                        : Qos::Durability::kVolatile;
  qos.depth = std::nullopt;
  if (in.contains("history")) qos.depth = in.at("history").get<std::uint32_t>();
  if (in.contains("deadline_ns"))
    qos.deadline = hal::Duration(in.at("deadline_ns").get<std::int64_t>());
  return qos;
}

json json_of(const Recorded& recorded) {
  json samples = json::array();
  for (const Recorded::Sample& one : recorded.samples)
    samples.push_back({one.at.count(), one.bytes});
  return {{"recorded", std::move(samples)},
          {"repeat_after_ns", recorded.repeat_after.count()},
          {"spread_ns", recorded.spread.count()}};
}

Recorded recorded_of(const json& in) {
  Recorded recorded{.samples = {},
                    .repeat_after = hal::Duration(in.at("repeat_after_ns").get<std::int64_t>()),
                    .spread = hal::Duration(in.at("spread_ns").get<std::int64_t>())};
  for (const json& one : in.at("recorded")) {
    recorded.samples.push_back(
        {hal::Duration(one.at(0).get<std::int64_t>()), one.at(1).get<std::uint32_t>()});
  }
  return recorded;
}

json json_of(const SentFlow& flow) {
  json out = json_of(flow.datagrams);
  out["port"] = flow.port;
  out["to"] = flow.to;
  return out;
}

json rhythm_json(const WrittenTopic& topic) {
  return std::visit(
      hal::Overloaded{
          [](const Periodic& c) -> json {
            return {{"rate", c.rate}, {"jitter_ns", c.jitter.count()}};
          },
          [](const Poisson& c) -> json {
            return {{"poisson", c.rate}};
          },
          [](const Bursts& c) -> json {
            return {{"bursts", c.rate}, {"samples", c.samples}, {"spacing_ns", c.spacing.count()}};
          },
          [](const Recorded& c) -> json { return json_of(c); }},
      topic.rhythm);
}

json sizes_json(const WrittenTopic& topic) {
  return std::visit(hal::Overloaded{[](const SizeCycle& c) -> json { return c.sizes; },
                                    [](const UniformSizes& c) -> json {
                                      return {{"from", c.from}, {"to", c.to}};
                                    }},
                    topic.sizes);
}

decltype(WrittenTopic::sizes) sizes_of(const json& in) {
  if (in.is_array()) return SizeCycle{in.get<std::vector<std::uint32_t>>()};
  return UniformSizes{in.at("from").get<std::uint32_t>(), in.at("to").get<std::uint32_t>()};
}

decltype(WrittenTopic::rhythm) rhythm_of(const json& in) {
  const auto nanoseconds = [&](const char* key) {
    return hal::Duration(in.at(key).get<std::int64_t>());
  };
  if (in.contains("rate")) return Periodic{in.at("rate").get<double>(), nanoseconds("jitter_ns")};
  if (in.contains("poisson")) return Poisson{in.at("poisson").get<double>()};
  if (in.contains("bursts")) {
    return Bursts{in.at("bursts").get<double>(), in.at("samples").get<std::uint32_t>(),
                  nanoseconds("spacing_ns")};
  }
  return recorded_of(in);
}

Plan plan_of(const json& in) {
  Plan plan{.name = in.at("name").get<std::string>(),
            .domain = in.at("domain").get<std::uint32_t>(),
            .seed = in.at("seed").get<std::uint64_t>(),
            .begin = hal::Duration(in.at("begin_ns").get<std::int64_t>()),
            .journal = in.at("journal").get<std::string>(),
            .writes = {},
            .reads = {}};
  for (const json& one : in.at("writes")) {
    plan.writes.push_back({one.at("topic").get<std::string>(), qos_of(one.at("qos")),
                           sizes_of(one.at("sizes")), rhythm_of(one.at("rhythm")),
                           one.at("participant").get<std::uint32_t>()});
  }
  for (const json& one : in.at("reads"))
    plan.reads.push_back({one.at("topic").get<std::string>(), qos_of(one.at("qos")),
                          one.at("participant").get<std::uint32_t>()});
  for (const json& one : in.at("flows")) {
    plan.flows.push_back({one.at("port").get<std::uint16_t>(),
                          one.at("to").get<std::vector<std::string>>(), recorded_of(one)});
  }
  plan.ports = in.at("ports").get<std::vector<std::uint16_t>>();
  return plan;
}

}  // namespace

std::vector<std::uint32_t> participants_of(const Plan& plan) {
  std::set<std::uint32_t> numbers;
  for (const WrittenTopic& topic : plan.writes) numbers.insert(topic.participant);
  for (const ReadTopic& topic : plan.reads) numbers.insert(topic.participant);
  if (numbers.empty()) numbers.insert(0);
  return {numbers.begin(), numbers.end()};
}

Plan part_of(const Plan& plan, std::uint32_t participant) {
  Plan part = plan;
  const auto is_others = [&](const auto& topic) { return topic.participant != participant; };
  std::erase_if(part.writes, is_others);
  std::erase_if(part.reads, is_others);
  if (participant != participants_of(plan).front()) {
    part.flows.clear();
    part.ports.clear();
  }
  return part;
}

std::string json_text(const Plan& plan) {
  json out = {{"name", plan.name},
              {"domain", plan.domain},
              {"seed", plan.seed},
              {"begin_ns", plan.begin.count()},
              {"journal", plan.journal.string()},
              {"writes", json::array()},
              {"reads", json::array()},
              {"flows", json::array()},
              {"ports", plan.ports}};
  for (const WrittenTopic& topic : plan.writes) {
    out["writes"].push_back({{"topic", topic.name},
                             {"qos", json_of(topic.qos)},
                             {"sizes", sizes_json(topic)},
                             {"rhythm", rhythm_json(topic)},
                             {"participant", topic.participant}});
  }
  for (const ReadTopic& topic : plan.reads)
    out["reads"].push_back(
        {{"topic", topic.name}, {"qos", json_of(topic.qos)}, {"participant", topic.participant}});
  for (const SentFlow& flow : plan.flows) out["flows"].push_back(json_of(flow));
  return out.dump(1) + "\n";
}

Plan parsed(const std::string& text) {
  try {
    return plan_of(json::parse(text));
  } catch (const json::exception& e) {
    throw std::runtime_error(e.what());
  }
}

Plan read_plan(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  if (!in) throw std::runtime_error(path.string() + ": cannot be read");
  try {
    return parsed(text.str());
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(path.string() + ": " + e.what());
  }
}

}  // namespace programs::topics
