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
#include "sim/scenario/tally.h"

namespace sim::scenario {

/// What of an observable goes into the results, besides its sums.
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
  std::optional<hal::Duration> every{std::chrono::seconds{1}};  ///< None: on change.
  Keeps keeps = Keeps::kSamples;
  std::size_t bins = 50;                             ///< Of a histogram.
  std::optional<std::pair<double, double>> range{};  ///< Of a histogram; none: automatic.
  std::uint64_t most = 100'000;  ///< Samples kept of one value of one agent; more are in the sums.
};

/// The parts of a request's name.
struct ObservablePattern {
  std::string domain, agents, value;

  /// None: it has not got three parts.
  static std::optional<ObservablePattern> of(std::string_view name);
  bool has_agent(std::string_view agent) const;
  bool has_value(std::string_view value_name) const;
};

/// One value of a reading.
struct ReadingValue {
  std::string channel;
  std::size_t index = 0;
};
/// A quantity of the simulation.
struct QuantityValue {
  const agents::Quantity* quantity = nullptr;
  std::size_t number = 0;
};
/// What its controller records.
struct RecordedValue {
  std::string name;
};

/// A value of one agent that can be observed.
struct Observable {
  std::string domain;  ///< "agents"
  std::string value;   ///< "x"
  std::string unit;    ///< "m"; "" if only the controller knows.
  std::variant<QuantityValue, Tally, ReadingValue, RecordedValue> source;
};

/// All that can be observed of an agent but what its controller records, which only the controller
/// knows.
std::vector<Observable> observables_of(const agents::AgentConfig& agent,
                                       const agents::SimulationConfig& config);

/// A kind of them, for people.
struct ObservableKind {
  std::string name;  ///< "agents.AGENT.x", "sensors.AGENT.CHANNEL.VALUE"
  std::string unit;
  std::string meaning;
};
std::vector<ObservableKind> observable_kinds();

/// "agents", "radio", …, "controllers".
std::vector<std::string> observable_domains();
inline constexpr std::string_view kControllersDomain = "controllers";

/// Names of the values of a reading, in their order, with units: {"x", "m"}; of a channel without
/// names of its own the numbers from 0; none if their number varies.
std::vector<std::pair<std::string, std::string>> values_of(const hal::Channel& channel);

}  // namespace sim::scenario
