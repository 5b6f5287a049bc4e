#include "hal/node/routing/aodv_hello.h"

#include <utility>
#include <vector>

namespace hal::node::routing {
namespace {

constexpr double kHelloJitter = 0.25;  // share of an interval, at most: RFC 5148, 5.4

Duration share_of(Duration whole, double fraction) {
  return Duration{static_cast<std::int64_t>(static_cast<double>(whole.count()) * fraction)};
}

}  // namespace

AodvHellos::AodvHellos(Node& node, const AodvTable& table, const AodvSearch& search, Outbox& outbox,
                       std::function<void(AgentId)> on_silence)
    : node_(node),
      table_(table),
      search_(search),
      outbox_(outbox),
      on_silence_(std::move(on_silence)) {}

void AodvHellos::start() {
  const Duration wait = share_of(node_.config.aodv.hello_interval, node_.random.uniform());
  node_.timers.schedule(node_.now() + wait, [this] { on_interval(); });
}

Duration AodvHellos::patience() const {
  const AodvConfig& config = node_.config.aodv;
  return config.hello_interval * config.allowed_hello_loss + config.hello_interval / 2;
}

void AodvHellos::on_interval() {
  const AodvConfig& config = node_.config.aodv;
  const Duration interval = config.hello_interval;
  const Duration wait = interval - share_of(interval, kHelloJitter * node_.random.uniform());
  node_.timers.schedule(node_.now() + wait, [this] { on_interval(); });
  check();
  const bool was_heard = last_broadcast_ && node_.now() - *last_broadcast_ < interval / 2;
  if (was_heard || search_.is_held() || !table_.is_on_active_route()) return;
  const Rrep hello{.hops = 0,
                   .destination = node_.self,
                   .destination_sequence = search_.own_sequence(),
                   .originator = node_.self,
                   .lifetime = interval * config.allowed_hello_loss};
  node_.count(ProtocolEvent::kHelloSent);
  on_broadcast();
  outbox_.send_control(kEveryone, Control{ControlOf::kAodv, encode(AodvPacket{1, hello})});
}

void AodvHellos::on_hello(AgentId from) { last_heard_[from] = node_.now(); }

void AodvHellos::on_heard(AgentId from) {
  const auto known = last_heard_.find(from);
  if (known != last_heard_.end()) known->second = node_.now();
}

void AodvHellos::check() {
  std::vector<AgentId> silent;
  for (const auto& [neighbour, heard] : last_heard_) {
    if (heard + patience() <= node_.now()) silent.push_back(neighbour);
  }
  for (const AgentId neighbour : silent) {
    forget(neighbour);
    on_silence_(neighbour);
  }
}

}  // namespace hal::node::routing
