#include "hal/files/description/routing_section.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "hal/files/description/field_io.h"

namespace hal::files::description {
namespace {

using node::routing::Algorithm;
using node::routing::LinkCapabilities;
using node::routing::RouteChoice;
using node::routing::RoutingConfig;

Option<Algorithm> option_of(Algorithm algorithm) { return {algorithm.name(), algorithm}; }

const std::array kNoRouting{option_of(Algorithm::kNone)};
constexpr std::array<Option<PathStatistic>, kPathStatistics.size()> kStatistics{
    {{"hops", PathStatistic::kHops},
     {"delay", PathStatistic::kDelay},
     {"min_snr", PathStatistic::kMinSnr},
     {"energy", PathStatistic::kEnergy}}};

const Key kAlgorithm{
    "algorithm",
    "Ants with the keys of the paper's algorithm; AntHocNet in full; AODV (RFC 3561); "
    "or flooding of every message. Each has keys of its own.",
    "aodv"};
const Key kMetric{"metric",
                  "What makes a path good, r(.) of equation 1: one statistic of its tuple (hops, "
                  "delay, min_snr, energy), or several with exponents, multiplied.",
                  "{hops: 1, delay: 0.5}"};
const Key kClasses{"classes", "Message classes that choose their routes in a way of their own.",
                   "{video: {metric: delay, beta: 4}}"};

/// How the router determines whether a hop works.
void ack_keys(Fields& io, RoutingConfig& c) {
  io.duration({"ack_timeout",
               "Until a frame that nobody acknowledged is repeated; doubled each time.", "50 ms"},
              {1e-4, 10}, c.ack_timeout);
  io.count({"ack_attempts", "Transmissions before a hop counts as failed.", "4"}, 1, 16,
           c.ack_attempts);
}

void hello_keys(Fields& io, RoutingConfig& c) {
  io.duration({"hello_period", "Between two hellos to the neighbours.", "1 s"}, {1e-3, 3600},
              c.hello_period);
  io.count({"hello_limit", "Hellos in a row that a neighbour may miss.", "2"}, 1, 100,
           c.hello_limit);
}

/// Keys that are used only if the link does not report the result of each frame.
void over_udp(Fields& io, const LinkCapabilities& link, const std::function<void(Fields&)>& body) {
  const Fields::When when = link.tx_status ? Fields::When{".link", {"udp_like"}}
                                           : Fields::When{};  // files without `link`
  io.only(!link.tx_status, when,
          "is not used with 'link: mac', which reports what becomes of each frame", body);
}

void hop_keys(Fields& io, RoutingConfig& c, const LinkCapabilities& link) {
  over_udp(io, link, [&](Fields& udp) {
    ack_keys(udp, c);
    hello_keys(udp, c);
  });
}

void choice_keys(Fields& io, RouteChoice& c) {
  io.number({"beta",
             "Exponent of the forwarding probability: the larger, the more the best next hop is "
             "preferred.",
             "2"},
            "1", {1, 100}, c.beta);
  io.number({"direct_weight",
             "Weight of a neighbour that is the destination itself, in place of the metric's; 0: "
             "it has the metric's, like the others.",
             "1000000"},
            "1", {0, 1e12}, c.metric.direct_weight);
}

void retry_keys(Fields& io, RoutingConfig& c) {
  io.duration({"retry_period", "Between two discoveries of one destination.", "5 s"}, {1e-3, 3600},
              c.retry_period);
  io.number({"retry_jitter",
             "Largest share of retry_period by which a repeated discovery comes early, at random.",
             "0.25"},
            "1", {0, 1}, c.retry_jitter);
  io.count({"retries", "Discoveries in all before a destination is given up.", "3"}, 1, 100,
           c.retries);
}

void acceptance_keys(Fields& io, RoutingConfig& c) {
  io.number({"acceptance",
             "Later copies of an ant are accepted with at most this times the fewest hops.", "1.5"},
            "1", {1, 100}, c.acceptance);
  io.flag({"accept_anywhere",
           "Whether every node accepts later copies; else only the destination does.", "true"},
          c.accept_anywhere);
}

void jitter_key(Fields& io, RoutingConfig& c) {
  io.duration({"jitter_max", "Rebroadcasts wait a random time up to this.", "100 ms"}, {0, 10},
              c.jitter_max);
}

void hop_limit_key(Fields& io, RoutingConfig& c) {
  io.count({"hop_limit", "Hops after which ants, floods and messages are dropped.", "30"}, 1, 100,
           c.hop_limit);
}

void buffer_keys(Fields& io, RoutingConfig& c) {
  io.count({"buffer_limit", "Messages that may wait for one route or next hop.", "64"}, 0,
           1'000'000, c.buffer_limit);
  io.duration({"buffer_age", "Longest wait of a message for a route.", "10 s"}, {1e-3, 3600},
              c.buffer_age);
}

/// The statistic, if the metric has only one; nullopt: it weighs several.
std::optional<PathStatistic> single(const PathMetric& metric) {
  for (const auto& one : kStatistics) {
    if (metric == path_metric(one.value, metric.direct_weight)) return one.value;
  }
  return std::nullopt;
}

void weight_key(Fields& io, const Option<PathStatistic>& statistic, PathMetric& metric) {
  const bool is_snr = statistic.value == PathStatistic::kMinSnr;
  double weight = io.is_writing() ? metric.weight(statistic.value) : 0;
  io.written_if(weight > 0, [&](Fields& written) {
    written.number({std::string(statistic.name),
                    is_snr ? "Exponent of this statistic's value in the product; the radio must "
                             "have waves."
                           : "Exponent of this statistic's value in the product.",
                    "0.5"},
                   "1", {0, 100}, weight);
  });
  if (!io.is_writing()) metric.set_weight(statistic.value, weight);
}

/// Several statistics with their exponents. The signal-to-noise ratio is not offered if it can have
/// no effect; a file that gives it gets an explanation.
void weight_keys(Fields& io, PathMetric& metric, const LinkCapabilities& link) {
  if (!io.is_writing()) metric = {.hops = 0, .direct_weight = metric.direct_weight};
  std::vector<std::string> given;
  if (io.reading() != nullptr) given = io.reading()->keys();
  for (const auto& one : kStatistics) {
    const bool is_offered = one.value != PathStatistic::kMinSnr || link.rssi;
    if (!is_offered && std::ranges::find(given, one.name) == given.end()) continue;
    const bool hangs_on_link = one.value == PathStatistic::kMinSnr && link.rssi;
    io.only(true, hangs_on_link ? Fields::When{".link", {"mac"}} : Fields::When{}, "",
            [&](Fields& weight) { weight_key(weight, one, metric); });
  }
}

void check_metric(Mapping& in, PathMetric& metric, const PathMetric& otherwise,
                  const LinkCapabilities& link) {
  if (std::ranges::all_of(kStatistics,
                          [&](const auto& one) { return metric.weight(one.value) == 0; })) {
    in.mistake(kMetric.name, "must weigh at least one of hops, delay, min_snr, energy");
    metric = otherwise;
  }
  if (metric.min_snr > 0 && !link.rssi && in.has(kMetric.name)) {
    in.mistake(kMetric.name,
               "'min_snr' needs a link that tells how strong frames arrive, which this one, a UDP "
               "socket or a radio without waves, does not");
    metric.min_snr = 0;
    metric.hops = 1;
  }
}

/// A statistic by its name, or a mapping of several statistics.
void metric_key(Fields& io, PathMetric& metric, const LinkCapabilities& link) {
  const PathMetric otherwise = metric;
  std::optional<PathStatistic> statistic = single(metric);
  Mapping* const in = io.reading();
  if (in != nullptr ? in->has_scalar(kMetric.name) : io.is_writing() && statistic) {
    PathStatistic named = in != nullptr ? PathStatistic::kHops : *statistic;
    io.choice(kMetric, kStatistics, named);
    metric = path_metric(named, otherwise.direct_weight);
  } else {
    io.inside_given(kMetric, io.is_writing(),
                    [&](Fields& weights) { weight_keys(weights, metric, link); });
  }
  if (in != nullptr) check_metric(*in, metric, otherwise, link);
}

/// Keys that a message class may set for itself.
void class_keys(Fields& io, RouteChoice& c, const LinkCapabilities& link) {
  metric_key(io, c.metric, link);
  choice_keys(io, c);
}

void classes_key(Fields& io, RoutingConfig& c, const LinkCapabilities& link) {
  std::vector<std::string> topics;
  topics.reserve(c.classes.size());
  for (const auto& one : c.classes) topics.push_back(one.first);
  io.inside_given(kClasses, !topics.empty(), [&](Fields& classes) {
    classes.named(
        {"NAME", "A message class, by its topic; what it does not say is as for the others."},
        topics, [&](Fields& keys, const std::string& topic) {
          RouteChoice& own = c.classes.try_emplace(topic, c.choice).first->second;
          class_keys(keys, own, link);
        });
  });
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
};

const Protocol* find(Algorithm algorithm) {
  const auto* const found = std::ranges::find(kProtocols, algorithm, &Protocol::algorithm);
  return found == kProtocols.end() ? nullptr : found;
}

void protocol_keys(Fields& io, RoutingConfig& c, const LinkCapabilities& link) {
  const Protocol* const protocol = find(c.algorithm);
  (protocol == nullptr ? common_keys : protocol->keys)(io, c, link);
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
                "How messages find their way over several hops, with these keys; or `none`: "
                "straight to the MAC, one hop."};
  const bool is_none = io.reading() != nullptr ? io.reading()->has_scalar(key.name)
                                               : c.algorithm == Algorithm::kNone;
  if (is_none) {
    c.algorithm = Algorithm::kNone;
    return io.choice(key, kNoRouting, c.algorithm);
  }
  io.inside(key, [&](Fields& keys) { keys_of(keys, c, link); });
}

}  // namespace hal::files::description
