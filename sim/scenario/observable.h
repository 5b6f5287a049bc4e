#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "hal/files/config/mapping.h"
#include "hal/types/agent_id.h"
#include "hal/types/channel.h"
#include "hal/types/time.h"
#include "sim/agents/quantities.h"
#include "sim/agents/simulation_config.h"
#include "sim/scenario/dds_value.h"
#include "sim/scenario/tally.h"

namespace sim::scenario {

/// What is kept of an observable in the results, in addition to its sums.
enum class Keeps : std::uint8_t { kSamples, kHistogram, kQuantiles, kCounter };
inline constexpr std::array<hal::files::config::Option<Keeps>, 4> kKeeps{
    {{"samples", Keeps::kSamples},
     {"histogram", Keeps::kHistogram},
     {"quantiles", Keeps::kQuantiles},
     {"counter", Keeps::kCounter}}};
std::string_view name(Keeps keeps);

/// One entry of `record: {observables: …}`.
struct ObservableRequest {
  /// DOMAIN.AGENT.VALUE, with `*` and `?` in the last two: "agents.r*.x".
  std::string name;
  std::optional<hal::Duration> every{std::chrono::seconds{1}};  ///< nullopt: at each change.
  Keeps keeps = Keeps::kSamples;
  std::size_t bins = 50;                             ///< For histograms.
  std::optional<std::pair<double, double>> range{};  ///< For histograms; nullopt: automatic.
  /// Samples kept per value and agent; further ones count only in the sums.
  std::uint64_t most = 100'000;
};

/// The parts of a request's name.
struct ObservablePattern {
  std::string domain, agents, value;

  /// Splits a name. @return nullopt if it does not have three parts.
  static std::optional<ObservablePattern> of(std::string_view name);
  bool has_agent(std::string_view agent) const;
  bool has_value(std::string_view value_name) const;
};

/// One value of a sensor reading.
struct ReadingValue {
  std::string channel;
  std::size_t index = 0;
};
/// A quantity of the simulation.
struct QuantityValue {
  const agents::Quantity* quantity = nullptr;
  std::size_t number = 0;
};
/// A value that the controller records.
struct RecordedValue {
  std::string name;
};

/// A value of a DDS topic.
struct TopicValue {
  std::uint32_t topic = 0;  ///< Index into air::Endpoints::topics().
  DdsValue value{};
};

/// A value of one agent that can be observed.
struct Observable {
  std::string domain;  ///< "agents"
  std::string value;   ///< "x"
  std::string unit;    ///< "m"; "" if only the controller knows it.
  std::variant<QuantityValue, Tally, ReadingValue, RecordedValue, TopicValue> source;
};

/// Everything that can be observed of an agent, except what its controller records, which only the
/// controller knows, and the values of DDS topics, which are known when they are announced.
std::vector<Observable> observables_of(const agents::AgentConfig& agent,
                                       const agents::SimulationConfig& config);

/// Description of a kind of observable, for lists.
struct ObservableKind {
  std::string name;  ///< "agents.AGENT.x", "sensors.AGENT.CHANNEL.VALUE"
  std::string unit;
  std::string meaning;
};
std::vector<ObservableKind> observable_kinds();

/// "agents", "radio", …, "controllers".
std::vector<std::string> observable_domains();
inline constexpr std::string_view kControllersDomain = "controllers";

/// Names and units of the values of a reading, in order: {"x", "m"}. For a channel without named
/// values, the names are numbers from 0; empty if the number of values varies.
std::vector<std::pair<std::string, std::string>> values_of(const hal::Channel& channel);

}  // namespace sim::scenario
