#include "sim/scenario/loss_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "hal/types/pattern.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {
namespace {

constexpr Range kProbability{0, 1};

void link_keys(Fields& io, radio::LossConfig::Link& link) {
  io.needed_text({"from", "Name of the transmitting agent, or a pattern with *.", "NAME0"},
                 link.from);
  io.needed_text({"to", "Name of the receiving agent, or a pattern with *.", "NAME*"}, link.to);
  io.needed({"probability", "Loss probability of a frame on this link.", "0.5"}, "1", kProbability,
            link.probability);
}

}  // namespace

void keys_of(Fields& io, radio::LossConfig& loss) {
  io.number(
      {"probability",
       "Probability that a receiver loses a frame that it would otherwise have received.", "0.05"},
      "1", kProbability, loss.probability);
  io.list<radio::LossConfig::Link>(
      {"links",
       "Directed links with their own probability; if several entries match a link, the last one "
       "counts.",
       "[{from: NAME0, to: NAME*, probability: 0.5}]"},
      loss.links, [](Fields& one, radio::LossConfig::Link& link) { link_keys(one, link); });
}

void check_loss_names(Mapping radio, const Scenario& scenario) {
  const auto check = [&scenario](Mapping& one, const char* key) {
    const std::string pattern = one.text({key, "", ""}, "*");
    const bool fits = std::ranges::any_of(
        scenario.simulation.agents,
        [&pattern](const agents::AgentConfig& agent) { return hal::matches(pattern, agent.name); });
    if (!fits) one.mistake(key, fmt::format("unknown agent: '{}' matches none", pattern));
  };
  Mapping loss = radio.within("loss");
  for (Mapping& one : loss.items("links")) {
    check(one, "from");
    check(one, "to");
  }
}

}  // namespace sim::scenario
