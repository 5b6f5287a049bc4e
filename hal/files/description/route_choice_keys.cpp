#include "hal/files/description/route_choice_keys.h"

#include <algorithm>
#include <string>
#include <vector>

namespace hal::files::description {
namespace {

using node::routing::LinkCapabilities;
using node::routing::RouteChoice;

constexpr std::array<Option<PathStatistic>, kPathStatistics.size()> kStatistics{
    {{"hops", PathStatistic::kHops},
     {"delay", PathStatistic::kDelay},
     {"min_snr", PathStatistic::kMinSnr},
     {"energy", PathStatistic::kEnergy}}};

const Key kMetric{
    "metric",
    "Quality of a path, r(.) of equation 1: by one of its statistics (hops, delay, min_snr, "
    "energy), or by the product of several, each raised to the exponent given here.",
    "{hops: 1, delay: 0.5}"};
const Key kClasses{"classes", "Message classes with their own choice of routes.",
                   "{video: {metric: delay, beta: 4}}"};

void choice_keys(Fields& io, RouteChoice& c) {
  io.number({"beta",
             "Exponent of the forwarding probability: the larger it is, the more often the best "
             "next hop is chosen.",
             "2"},
            "1", {1, 100}, c.beta);
  io.number({"direct_weight",
             "Weight of a neighbour that is itself the destination, used instead of its metric; 0: "
             "its metric is used, as for the others.",
             "1000000"},
            "1", {0, 1e12}, c.metric.direct_weight);
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
                    is_snr ? "Exponent of this statistic in the product; needs a radio profile "
                             "that models received power."
                           : "Exponent of this statistic in the product; 0: it is not used.",
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
               "'min_snr' needs a link that reports the received power of frames; a UDP socket and "
               "radios without waves do not");
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

}  // namespace

void class_keys(Fields& io, RouteChoice& c, const LinkCapabilities& link) {
  metric_key(io, c.metric, link);
  choice_keys(io, c);
}

void classes_key(Fields& io, node::routing::RoutingConfig& c, const LinkCapabilities& link) {
  std::vector<std::string> topics;
  topics.reserve(c.classes.size());
  for (const auto& one : c.classes) topics.push_back(one.first);
  io.inside_given(kClasses, !topics.empty(), [&](Fields& classes) {
    classes.named({"NAME",
                   "Routing of the messages of one topic (here NAME); keys that are absent have "
                   "the values of the section above."},
                  topics, [&](Fields& keys, const std::string& topic) {
                    RouteChoice& own = c.classes.try_emplace(topic, c.choice).first->second;
                    class_keys(keys, own, link);
                  });
  });
}

}  // namespace hal::files::description
