#include "sim/scenario/countable.h"

#include <algorithm>
#include <array>
#include <set>

#include "hal/node/routing/possible_events.h"
#include "hal/types/verdict.h"
#include "sim/air/air_kind.h"
#include "sim/air/sample_loss.h"
#include "sim/radio/mac/frame_class.h"
#include "sim/radio/possible_verdicts.h"

namespace sim::scenario {
namespace {

using hal::Verdict;

/// Results that messages to one agent can have, whatever carries them.
constexpr std::array kMessageVerdicts{
    Verdict::kDelivered, Verdict::kRetryLimit, Verdict::kQueueFull, Verdict::kRadioOff,
    Verdict::kNoRoute,   Verdict::kExpired,    Verdict::kQueueDelay};

bool has_access_points(const agents::SimulationConfig& config) {
  const radio::DcfConfig* const dcf = radio::dcf_of(config.radio);
  if (dcf == nullptr) return false;
  return !dcf->bss.access_points.empty() ||
         std::ranges::any_of(config.agents, [](const agents::AgentConfig& agent) {
           return agent.radio.access_points && !agent.radio.access_points->empty();
         });
}

/// Whether stations may agree on Block Ack, by action frames.
bool has_block_ack(const agents::SimulationConfig& config) {
  const radio::DcfConfig* const dcf = radio::dcf_of(config.radio);
  return dcf != nullptr && dcf->qos && dcf->aggregation.block_ack_window > 0;
}

std::vector<radio::FrameClass> frame_classes(const agents::SimulationConfig& config) {
  std::vector<radio::FrameClass> classes = {radio::FrameClass::kBroadcast,
                                            radio::FrameClass::kUnicast};
  if (radio::waves_of(config.radio) == nullptr) return classes;
  classes.insert(classes.end(),
                 {radio::FrameClass::kRts, radio::FrameClass::kCts, radio::FrameClass::kAck});
  const bool has_bss = has_access_points(config), has_actions = has_block_ack(config);
  if (has_bss) classes.push_back(radio::FrameClass::kBeacon);
  if (has_bss || has_actions) classes.push_back(radio::FrameClass::kManagement);
  if (has_actions) classes.push_back(radio::FrameClass::kBlockAck);
  return classes;
}

class Words {
 public:
  void add(const char* family, std::string_view word) {
    all_.push_back({family, "", std::string(word)});
  }
  template <class Verdicts>
  void add_verdicts(const char* family, const Verdicts& verdicts) {
    for (const Verdict verdict : verdicts) add(family, hal::name(verdict));
  }
  std::vector<Countable> take() { return std::move(all_); }

 private:
  std::vector<Countable> all_;
};

void add_frames(const agents::SimulationConfig& config, Words& words) {
  for (const radio::FrameClass one : frame_classes(config)) words.add("frames", radio::name(one));
  words.add_verdicts("receptions", radio::reception_verdicts(config.radio));
  words.add("receptions", "under way");
  words.add_verdicts("requests", radio::request_verdicts(config.radio, has_access_points(config)));
  words.add("requests", "transmitted");
}

void add_routing(const agents::SimulationConfig& config, Words& words) {
  std::set<hal::node::routing::ProtocolEvent> events;
  for (const agents::AgentConfig& agent : config.agents) {
    const auto of = hal::node::routing::possible_events(
        agent.routing.value_or(config.routing.algorithm), config.link == agents::LinkKind::kMac);
    events.insert(of.begin(), of.end());
  }
  for (const auto event : events) words.add("routing.events", hal::node::routing::name(event));
}

/// Purposes of what is on the air, and causes of losses of samples: outcomes of the frames and
/// requests that carried them, or those of sim::air::LossCause.
void add_air(const agents::SimulationConfig& config, bool samples, Words& words) {
  for (int i = 0; i < air::kPurposes; ++i)
    words.add("air", air::name(static_cast<air::Purpose>(i)));
  if (!samples) return;
  std::set<std::string_view> causes{air::name(air::LossCause::Kind::kNotMatched),
                                    air::name(air::LossCause::Kind::kUnknown)};
  for (const Verdict verdict : radio::reception_verdicts(config.radio))
    causes.insert(hal::name(verdict));
  for (const Verdict verdict : radio::request_verdicts(config.radio, has_access_points(config)))
    causes.insert(hal::name(verdict));
  causes.erase(hal::name(Verdict::kDelivered));
  for (const std::string_view cause : causes) words.add("dds.lost", cause);
}

}  // namespace

std::vector<Countable> countable_of(const agents::SimulationConfig& config,
                                    const Counted& counted) {
  Words words;
  if (counted.frames) add_frames(config, words);
  if (counted.messages) {
    words.add_verdicts("messages.ends", kMessageVerdicts);
    words.add("messages.ends", "under way");
  }
  add_routing(config, words);
  if (std::ranges::any_of(config.agents, [](const auto& one) { return one.network.has_value(); }))
    add_air(config, counted.samples, words);
  return words.take();
}

}  // namespace sim::scenario
