#include "sim/scenario/loss_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "hal/types/pattern.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {
namespace {

constexpr Range kProbability{0, 1};

}  // namespace

radio::LossConfig read_loss(Mapping in) {
  radio::LossConfig loss;
  loss.probability = in.number(
      {"probability", "That a frame which the physics let in is lost at a receiver.", "0.05"}, "1",
      kProbability, loss.probability);
  for (Mapping& one : in.mappings({"links",
                                   "Links, each one way, with a probability of their own; of "
                                   "several that fit the last one counts.",
                                   "[{from: NAME0, to: NAME*, probability: 0.5}]"})) {
    radio::LossConfig::Link link;
    link.from = one.text({"from", "Name of the transmitter, or a pattern with *.", "NAME0"});
    link.to = one.text({"to", "Name of the receiver, or a pattern with *.", "NAME*"});
    link.probability =
        one.number({"probability", "Likewise, on this link.", "0.5"}, "1", kProbability);
    one.finish();
    loss.links.push_back(link);
  }
  in.finish();
  return loss;
}

void write_loss(Writer& out, const radio::LossConfig& loss) {
  out.open("loss");
  out.number("probability", loss.probability, "1");
  out.open_list("links");
  for (const radio::LossConfig::Link& link : loss.links) {
    out.open_item();
    out.text("from", link.from);
    out.text("to", link.to);
    out.number("probability", link.probability, "1");
    out.close();
  }
  out.close();
  out.close();
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
