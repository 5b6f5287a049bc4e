#include "sim/radio/mac/channel_access.h"

#include <algorithm>
#include <utility>

namespace sim::radio {

ChannelAccess::ChannelAccess(EventQueue& events, hal::AgentId agent, const Rules& rules,
                             const hal::RandomStream& random, ChannelAccessListener& listener)
    : events_(events), agent_(agent), random_(random), listener_(listener) {
  const DcfConfig& config = rules.config;
  if (config.qos) {
    for (const AccessParameters& category : config.edca.categories) {
      add(category, rules.timing, true);
    }
    return;
  }
  constexpr std::uint32_t kDifsSlots = 2;
  add({config.contention.cw_min, config.contention.cw_max, kDifsSlots, {}}, rules.timing, false);
}

void ChannelAccess::add(const AccessParameters& parameters, const DcfTiming& timing,
                        bool counts_first) {
  const AccessTiming own{.slot = timing.slot,
                         .aifs = timing.sifs + parameters.aifsn * timing.slot,
                         .cca_time = timing.cca_time,
                         .counts_first = counts_first};
  if (!first_) {
    first_.emplace(*this, events_, agent_, Function::Settings{0, parameters, own});
    return;
  }
  others_.push_back(std::make_unique<Function>(*this, events_, agent_,
                                               Function::Settings{functions(), parameters, own}));
}

void ChannelAccess::set(const EdcaConfig& edca, const DcfTiming& timing) {
  if (functions() < kAccessCategories) return;
  for (std::size_t i = 0; i < kAccessCategories; ++i) {
    const AccessParameters& parameters = edca.categories[i];
    Function& one = at(i);
    one.txop_limit = parameters.txop_limit;
    one.window.set_limits(parameters.cw_min, parameters.cw_max);
    one.backoff.set_aifs(timing.sifs + parameters.aifsn * timing.slot);
  }
}

void ChannelAccess::request(ContentionFunction function) {
  Function& one = at(function);
  one.backoff.request(one.window.value());
}

void ChannelAccess::draw(ContentionFunction function) {
  Function& one = at(function);
  one.backoff.draw(one.window.value());
}

void ChannelAccess::on_busy() {
  each([](Function& one) { one.backoff.on_busy(one.window.value()); });
}

void ChannelAccess::on_idle() {
  each([](Function& one) { one.backoff.on_idle(); });
}

void ChannelAccess::hold_until(hal::Time until) {
  each([until](Function& one) { one.backoff.hold_until(until); });
}

void ChannelAccess::reset(bool busy) {
  ready_.clear();
  each([busy](Function& one) {
    one.window.reset();
    one.backoff.reset(busy);
  });
}

void ChannelAccess::on_access(ContentionFunction function) {
  if (others_.empty()) return listener_.on_access(function);
  ready_.push_back(function);
  // The backoffs of other functions that end now come before this event.
  if (ready_.size() == 1) {
    events_.schedule(events_.now(), Rank::kRadio, agent_, [this] { arbitrate(); });
  }
}

void ChannelAccess::arbitrate() {
  if (ready_.empty()) return;  // the radio was switched off at this very time
  std::vector<ContentionFunction> ready = std::exchange(ready_, {});
  std::ranges::sort(ready);
  const ContentionFunction highest = ready.back();
  ready.pop_back();
  // The medium is busy before the others draw.
  listener_.on_access(highest);
  for (const ContentionFunction lower : ready) listener_.on_internal_collision(lower);
}

}  // namespace sim::radio
