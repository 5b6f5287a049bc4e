#include "hal/files/description/routing_section.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "hal/files/description/field_io.h"
#include "hal/files/description/priority_keys.h"
#include "hal/files/description/route_choice_keys.h"

namespace hal::files::description {
namespace {

using node::routing::Algorithm;
using node::routing::LinkCapabilities;
using node::routing::RoutingConfig;

Option<Algorithm> option_of(Algorithm algorithm) { return {algorithm.name(), algorithm}; }

const std::array kNoRouting{option_of(Algorithm::kNone)};
const Key kAlgorithm{
    "algorithm",
    "Routing protocol: `ants`, the ant routing of the paper; `anthocnet`, the complete AntHocNet; "
    "`aodv` (RFC 3561); `static`, next hops given by `routes`; or `flooding` of every message. "
    "Each "
    "has keys of its own.",
    "aodv"};
/// How the router determines whether a hop works.
void ack_keys(Fields& io, RoutingConfig& c) {
  io.duration({"ack_timeout",
               "Time to wait for the acknowledgement of a frame before it is repeated; doubled "
               "with each repetition.",
               "50 ms"},
              {1e-4, 10}, c.ack_timeout);
  io.count({"ack_attempts", "Transmissions of a frame after which its hop counts as failed.", "4"},
           1, 16, c.ack_attempts);
}

void hello_keys(Fields& io, RoutingConfig& c) {
  io.duration({"hello_period", "Time between two hello messages to the neighbours.", "1 s"},
              {1e-3, 3600}, c.hello_period);
  io.count({"hello_limit",
            "Consecutive hello messages of a neighbour that may be lost before the neighbour "
            "itself counts as lost.",
            "2"},
           1, 100, c.hello_limit);
}

/// Keys that are used only if the link does not report the result of each frame.
void over_udp(Fields& io, const LinkCapabilities& link, const std::function<void(Fields&)>& body) {
  const Fields::When when = link.tx_status ? Fields::When{".link", {"udp_like"}}
                                           : Fields::When{};  // files without `link`
  io.only(!link.tx_status, when,
          "is not used with 'link: mac', which reports the outcome of each frame", body);
}

void hop_keys(Fields& io, RoutingConfig& c, const LinkCapabilities& link) {
  over_udp(io, link, [&](Fields& udp) {
    ack_keys(udp, c);
    hello_keys(udp, c);
  });
}

void retry_keys(Fields& io, RoutingConfig& c) {
  io.duration(
      {"retry_period", "Time between two route discoveries for the same destination.", "5 s"},
      {1e-3, 3600}, c.retry_period);
  io.number(
      {"retry_jitter",
       "Largest share of retry_period by which a repeated discovery starts early; drawn at random.",
       "0.25"},
      "1", {0, 1}, c.retry_jitter);
  io.count({"retries", "Route discoveries in total before a destination is given up.", "3"}, 1, 100,
           c.retries);
}

void acceptance_keys(Fields& io, RoutingConfig& c) {
  io.number({"acceptance",
             "A node accepts a later copy of an ant only if the hops and the travel time of the "
             "copy are at most this factor times the best so far.",
             "1.5"},
            "1", {1, 100}, c.acceptance);
  io.flag({"accept_anywhere",
           "Whether every node accepts later copies of an ant; if not, only the destination does.",
           "true"},
          c.accept_anywhere);
}

void jitter_key(Fields& io, RoutingConfig& c) {
  io.duration({"jitter_max", "Largest random delay before a rebroadcast.", "100 ms"}, {0, 10},
              c.jitter_max);
}

void hop_limit_key(Fields& io, RoutingConfig& c) {
  io.count(
      {"hop_limit",
       "Largest number of hops of ants, floods and messages; those that need more are dropped.",
       "30"},
      1, 100, c.hop_limit);
}

void buffer_keys(Fields& io, RoutingConfig& c) {
  io.count({"buffer_limit", "Messages that may wait for one route or one next hop.", "64"}, 0,
           1'000'000, c.buffer_limit);
  io.duration({"buffer_age", "Longest time for which a message waits for a route.", "10 s"},
              {1e-3, 3600}, c.buffer_age);
}

/// Keys of every protocol, including those defined by programs that link the simulator.
void common_keys(Fields& io, RoutingConfig& c, const LinkCapabilities& link) {
  jitter_key(io, c);
  hop_limit_key(io, c);
  hop_keys(io, c, link);
}

void ant_keys(Fields& io, RoutingConfig& c, const LinkCapabilities& link) {
  class_keys(io, c.choice, link);
  jitter_key(io, c);
  retry_keys(io, c);
  acceptance_keys(io, c);
  hop_limit_key(io, c);
  buffer_keys(io, c);
  hop_keys(io, c, link);
  classes_key(io, c, link);
}

/// AntHocNet's hellos carry pheromone, so they are sent over any link.
void all_anthocnet_keys(Fields& io, RoutingConfig& c, const LinkCapabilities& link) {
  jitter_key(io, c);
  retry_keys(io, c);
  keys_of(io, c.anthocnet);
  hop_limit_key(io, c);
  buffer_keys(io, c);
  over_udp(io, link, [&](Fields& udp) { ack_keys(udp, c); });
  hello_keys(io, c);
}

void all_aodv_keys(Fields& io, RoutingConfig& c, const LinkCapabilities& link) {
  jitter_key(io, c);
  keys_of(io, c.aodv);
  hop_limit_key(io, c);
  buffer_keys(io, c);
  hop_keys(io, c, link);
}

void all_static_keys(Fields& io, RoutingConfig& c, const LinkCapabilities& link) {
  keys_of(io, c.statics);
  common_keys(io, c, link);
}

/// What AntHocNet has in place of the defaults of RoutingConfig: a jitter that is small against the
/// time a repair is waited for, and the retry of its authors' port.
void anthocnet_defaults(RoutingConfig& c) {
  c.jitter_max = std::chrono::milliseconds{10};
  c.retry_period = std::chrono::seconds{2};
}

/// Well below NODE_TRAVERSAL_TIME. The RFC names no longest wait of a rebroadcast.
void aodv_defaults(RoutingConfig& c) { c.jitter_max = std::chrono::milliseconds{10}; }

/// A protocol that files can name.
struct Protocol {
  Algorithm algorithm;
  void (*set_defaults)(RoutingConfig& c);  ///< If they differ from those of RoutingConfig.
  void (*keys)(Fields& io, RoutingConfig& c, const LinkCapabilities& link);
};

const std::array kProtocols{
    Protocol{Algorithm::kAnts, [](RoutingConfig&) {}, ant_keys},
    Protocol{Algorithm::kAntHocNet, anthocnet_defaults, all_anthocnet_keys},
    Protocol{Algorithm::kAodv, aodv_defaults, all_aodv_keys},
    Protocol{Algorithm::kFlooding, [](RoutingConfig&) {}, common_keys},
    Protocol{Algorithm::kStatic, [](RoutingConfig&) {}, all_static_keys},
};

const Protocol* find(Algorithm algorithm) {
  const auto* const found = std::ranges::find(kProtocols, algorithm, &Protocol::algorithm);
  return found == kProtocols.end() ? nullptr : found;
}

void protocol_keys(Fields& io, RoutingConfig& c, const LinkCapabilities& link) {
  const Protocol* const protocol = find(c.algorithm);
  (protocol == nullptr ? common_keys : protocol->keys)(io, c, link);
  priority_key(io,
               {"control_priority",
                "User priority of the packets of routing itself, as in `priorities`. Routing "
                "daemons on Linux mark theirs CS6, which is 6 (RFC 4594).",
                "6"},
               c.control_priority);
}

std::vector<Option<Algorithm>> options_of_protocols() {
  std::vector<Option<Algorithm>> options;
  options.reserve(kProtocols.size() + 1);
  for (const Protocol& one : kProtocols) options.push_back(option_of(one.algorithm));
  return options;
}

RoutingConfig defaults_of(Algorithm algorithm) {
  RoutingConfig config{.algorithm = algorithm};
  if (const Protocol* const protocol = find(algorithm)) protocol->set_defaults(config);
  return config;
}

FieldNames names_of(Algorithm algorithm, const LinkCapabilities& link) {
  RoutingConfig config{.algorithm = algorithm};
  FieldNames names;
  protocol_keys(names, config, link);
  return names;
}

/// Refuses keys of other protocols, which have no effect here.
void refuse_others(Mapping& in, Algorithm algorithm, const LinkCapabilities& link) {
  FieldNames known = names_of(algorithm, link);
  for (const Protocol& other : kProtocols) {
    const FieldNames theirs = names_of(other.algorithm, link);
    for (const std::string& key : theirs.all()) {
      if (known.has(key)) continue;
      known.unused(key, "");
      in.refuse(key, "is a key of 'algorithm: " + std::string(other.algorithm.name()) +
                         "' and means nothing with 'algorithm: " + std::string(algorithm.name()) +
                         "'");
    }
  }
}

void keys_of(Fields& io, RoutingConfig& c, const LinkCapabilities& link) {
  if (io.is_writing()) {  // also algorithms that files cannot name
    std::string name(c.algorithm.name());
    io.text(kAlgorithm, name);
    return protocol_keys(io, c, link);
  }
  Algorithm algorithm = c.algorithm;
  io.choice(kAlgorithm, options_of_protocols(), algorithm, [&](Fields& keys) {
    c = defaults_of(algorithm);
    protocol_keys(keys, c, link);
    if (keys.reading() != nullptr) refuse_others(*keys.reading(), algorithm, link);
  });
}

}  // namespace

std::vector<Option<Algorithm>> routing_algorithms() {
  std::vector<Option<Algorithm>> all = options_of_protocols();
  all.push_back(option_of(Algorithm::kNone));
  return all;
}

void routing_key(Fields& io, RoutingConfig& c, const LinkCapabilities& link) {
  const Key key{"routing",
                "How messages are forwarded over several hops, with these keys; or `none`: no "
                "routing, messages go directly to the MAC and travel one hop."};
  const bool is_none = io.reading() != nullptr ? io.reading()->has_scalar(key.name)
                                               : c.algorithm == Algorithm::kNone;
  if (is_none) {
    c.algorithm = Algorithm::kNone;
    return io.choice(key, kNoRouting, c.algorithm);
  }
  io.inside(key, [&](Fields& keys) { keys_of(keys, c, link); });
}

}  // namespace hal::files::description
