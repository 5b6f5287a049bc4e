#include "hal/files/description/routing_section.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "hal/files/description/anthocnet_keys.h"
#include "hal/files/description/aodv_keys.h"
#include "hal/files/description/field_io.h"

namespace hal::files::description {
namespace {

using node::routing::Algorithm;
using node::routing::LinkCapabilities;
using node::routing::RouteChoice;
using node::routing::RoutingConfig;

const std::array kNoRouting{option_of(Algorithm::kNone)};
/// Those that have keys.
const std::array kAlgorithms{option_of(Algorithm::kAnts), option_of(Algorithm::kAntHocNet),
                             option_of(Algorithm::kAodv), option_of(Algorithm::kFlooding)};
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

/// How the router finds out for itself whether a hop works.
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

/// AntHocNet's hellos carry pheromone: it sends them over any link.
void hop_keys(Fields& io, RoutingConfig& c, const LinkCapabilities& link) {
  const char* unused = "is not used with 'link: mac', which reports what becomes of each frame";
  const bool has_hellos = !link.tx_status || c.algorithm == Algorithm::kAntHocNet;
  if (link.tx_status) {
    for (const char* key : {"ack_timeout", "ack_attempts"}) io.unused(key, unused);
  } else {
    ack_keys(io, c);
  }
  if (has_hellos) return hello_keys(io, c);
  for (const char* key : {"hello_period", "hello_limit"}) io.unused(key, unused);
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

/// Whether messages wait there for routes.
bool has_buffer(Algorithm algorithm) {
  return algorithm == Algorithm::kAnts || algorithm == Algorithm::kAntHocNet ||
         algorithm == Algorithm::kAodv;
}

PathMetric read_weights(Mapping& in, const PathMetric& otherwise, const LinkCapabilities& link) {
  PathMetric metric{.hops = 0, .direct_weight = otherwise.direct_weight};
  Mapping weights = in.mapping(kMetric);
  const std::vector<std::string> given = weights.keys();
  double total = 0;
  for (const auto& [name, statistic] : kStatistics) {
    // Where it can have no effect it is not offered; who gives it is told why.
    const bool is_offered = statistic != PathStatistic::kMinSnr || link.rssi;
    if (!is_offered && std::ranges::find(given, name) == given.end()) continue;
    const Key key{std::string(name), "Exponent of this statistic's value in the product.", "0.5"};
    const double weight = weights.number(key, "1", {0, 100}, 0);
    metric.set_weight(statistic, weight);
    total += weight;
  }
  weights.finish();
  if (total > 0) return metric;
  in.mistake(kMetric.name, "must weigh at least one of hops, delay, min_snr, energy");
  return otherwise;
}

PathMetric read_metric(Mapping& in, const PathMetric& otherwise, const LinkCapabilities& link) {
  PathMetric metric = otherwise;
  if (in.has_scalar(kMetric.name)) {
    const auto statistic = in.choice(kMetric, kStatistics, PathStatistic::kHops);
    metric = path_metric(statistic, otherwise.direct_weight);
  } else if (in.has(kMetric.name)) {
    metric = read_weights(in, otherwise, link);
  }
  if (metric.min_snr > 0 && !link.rssi && in.has(kMetric.name)) {
    in.mistake(kMetric.name,
               "'min_snr' needs a link that tells how strong frames arrive, which this one, a UDP "
               "socket or a radio without waves, does not");
    metric.min_snr = 0;
    metric.hops = 1;
  }
  return metric;
}

void write_metric(Writer& out, const PathMetric& metric) {
  for (const auto& [name, statistic] : kStatistics) {
    if (metric == path_metric(statistic, metric.direct_weight)) {
      return out.text(kMetric.name, name);
    }
  }
  out.open(kMetric.name);
  for (const auto& [name, statistic] : kStatistics) {
    if (metric.weight(statistic) > 0) out.number(name, metric.weight(statistic), "1");
  }
  out.close();
}

/// What a message class may choose for itself.
void class_keys(Fields& io, RouteChoice& c, const LinkCapabilities& link) {
  io.own(
      kMetric, [&](Mapping& in) { c.metric = read_metric(in, c.metric, link); },
      [&](Writer& out) { write_metric(out, c.metric); });
  choice_keys(io, c);
}

void read_classes(Mapping& in, RoutingConfig& config, const LinkCapabilities& link) {
  if (!in.has(kClasses.name)) return;
  Mapping classes = in.mapping(kClasses);
  for (const std::string& topic : classes.keys()) {
    RouteChoice& own = config.classes.insert_or_assign(topic, config.choice).first->second;
    FieldReader(classes).inside(
        {topic, "A message class, by its topic; what it does not say is as for the others."},
        [&](Fields& io) { class_keys(io, own, link); });
  }
  classes.finish();
}

void write_classes(Writer& out, RoutingConfig& config, const LinkCapabilities& link) {
  if (config.classes.empty()) return;
  FieldWriter(out).inside(kClasses, [&](Fields& io) {
    for (auto& one : config.classes) {
      io.inside({one.first, ""}, [&](Fields& own) { class_keys(own, one.second, link); });
    }
  });
}

/// Of the algorithm that `c` names.
void algorithm_keys(Fields& io, RoutingConfig& c, const LinkCapabilities& link) {
  const bool is_by_ants = c.algorithm == Algorithm::kAnts;
  if (is_by_ants) class_keys(io, c.choice, link);
  jitter_key(io, c);
  if (is_by_ants || c.algorithm == Algorithm::kAntHocNet) retry_keys(io, c);
  if (is_by_ants) acceptance_keys(io, c);
  if (c.algorithm == Algorithm::kAntHocNet) anthocnet_keys(io, c.anthocnet);
  if (c.algorithm == Algorithm::kAodv) aodv_keys(io, c.aodv);
  hop_limit_key(io, c);
  if (has_buffer(c.algorithm)) buffer_keys(io, c);
  hop_keys(io, c, link);
  if (!is_by_ants) return;
  io.own(
      kClasses, [&](Mapping& in) { read_classes(in, c, link); },
      [&](Writer& out) { write_classes(out, c, link); });
}

FieldNames names_of(Algorithm algorithm, const LinkCapabilities& link) {
  RoutingConfig config{.algorithm = algorithm};
  FieldNames names;
  algorithm_keys(names, config, link);
  return names;
}

/// Keys of other algorithms mean nothing here.
void refuse_others(Mapping& in, Algorithm algorithm, const LinkCapabilities& link) {
  FieldNames known = names_of(algorithm, link);
  for (const auto& other : kAlgorithms) {
    const FieldNames theirs = names_of(other.value, link);
    for (const std::string& key : theirs.all()) {
      if (known.has(key)) continue;
      known.unused(key, "");
      in.refuse(key, "is a key of 'algorithm: " + std::string(other.name) +
                         "' and means nothing with 'algorithm: " + std::string(algorithm.name()) +
                         "'");
    }
  }
}

}  // namespace

RoutingConfig read_routing(Mapping& in, const LinkCapabilities& link) {
  const Key key{"routing",
                "How messages find their way over several hops, with these keys; or `none`: "
                "straight to the MAC, one hop."};
  RoutingConfig config;
  if (in.has_scalar(key.name)) {
    config.algorithm = in.choice(key, kNoRouting, Algorithm::kNone);
    return config;
  }
  Mapping keys = in.mapping(key);
  config.algorithm = keys.choice(kAlgorithm, kAlgorithms, config.algorithm);
  if (config.algorithm == Algorithm::kAodv) config.jitter_max = kAodvJitter;
  if (config.algorithm == Algorithm::kAntHocNet) anthocnet_defaults(config);
  FieldReader reader(keys);
  algorithm_keys(reader, config, link);
  refuse_others(keys, config.algorithm, link);
  keys.finish();
  return config;
}

void write_routing(Writer& out, RoutingConfig config, const LinkCapabilities& link) {
  if (config.algorithm == Algorithm::kNone) return out.text("routing", kNoRouting[0].name);
  FieldWriter(out).inside({"routing", ""}, [&](Fields& io) {
    out.text(kAlgorithm.name, config.algorithm.name());
    algorithm_keys(io, config, link);
  });
}

}  // namespace hal::files::description
