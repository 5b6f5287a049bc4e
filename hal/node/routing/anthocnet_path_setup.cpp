#include "hal/node/routing/anthocnet_path_setup.h"

namespace hal::node::routing::anthocnet {

void PathSetup::begin(const Target& target) {
  const auto [search, is_new] = searches_.try_emplace(target);
  if (!is_new) return;
  search->second.started = node_.now();
  search->second.first_sequence = node_.last_sequence + 1;
  try_once(target);
}

void PathSetup::try_once(const Target& target) {
  Search& search = searches_.at(target);
  ++search.tries;
  search.retry = node_.timers.schedule(node_.now() + wait_after(search.tries),
                                       [this, target] { on_retry(target); });
  ants_.launch(target, AntKind::kReactive);
}

/// Time until the next try or, after the last one, until the search is given up.
Duration PathSetup::wait_after(int tries) {
  const Duration period = node_.config.retry_period;
  const double share = node_.config.retry_jitter;
  if (share <= 0 || tries >= node_.config.retries) return period;
  const double early = share * static_cast<double>(period.count());
  return period - Duration{static_cast<std::int64_t>(node_.retry_random.uniform() * early)};
}

void PathSetup::on_retry(const Target& target) {
  diffusion_.know(target);
  if (table_.has_regular(target)) {
    end(target, true);
    return on_trail_(target);
  }
  if (searches_.at(target).tries < node_.config.retries) return try_once(target);
  end(target, false);
  backlog_.abandon(target, Verdict::kNoRoute);
}

void PathSetup::on_home(const Target& target, Sequence sequence) {
  const auto search = searches_.find(target);
  if (search == searches_.end() || sequence < search->second.first_sequence) return;
  node_.timers.cancel(search->second.retry);
  end(target, true);
}

void PathSetup::end(const Target& target, bool found) {
  const auto search = searches_.extract(target);
  node_.ports.observer.on_discovery(target.topic, target.destination,
                                    node_.now() - search.mapped().started, found);
}

}  // namespace hal::node::routing::anthocnet
