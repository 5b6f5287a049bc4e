#include "hal/description/routing_section.h"

#include "hal/description/fields.h"

namespace hal::description {
namespace {

using routing::Algorithm;
using routing::RoutingConfig;

constexpr std::array<Option<Algorithm>, 1> kNoRouting{{{"none", Algorithm::kNone}}};

/// How the router finds out for itself whether a hop works.
template <class Io>
void hop_keys(Io& io, RoutingConfig& c, TransmitStatus status) {
  if (status == TransmitStatus::kReported) {
    for (const char* key : {"ack_timeout", "ack_attempts", "hello_period", "hello_limit"}) {
      io.unused(key, "is not used with 'link: mac', which reports what becomes of each frame");
    }
    return;
  }
  io.duration({"ack_timeout",
               "Until a frame that nobody acknowledged is repeated; doubled each time.", "50 ms"},
              {1e-4, 10}, c.ack_timeout);
  io.count({"ack_attempts", "Transmissions before a hop counts as failed.", "4"}, 1, 16,
           c.ack_attempts);
  io.duration({"hello_period", "Between two hellos to the neighbours.", "1 s"}, {1e-3, 3600},
              c.hello_period);
  io.count({"hello_limit", "Hellos in a row that a neighbour may miss.", "2"}, 1, 100,
           c.hello_limit);
}

template <class Io>
void routing_keys(Io& io, RoutingConfig& c, TransmitStatus status) {
  io.number({"beta",
             "Exponent of the forwarding probability: the larger, the more the best next hop is "
             "preferred.",
             "2"},
            "1", {1, 100}, c.choice.beta);
  io.number(
      {"direct_weight",
       "Weight of a neighbour that is the destination itself; others have 1 / hops.", "1000000"},
      "1", {1, 1e12}, c.choice.metric.direct_weight);
  io.duration({"jitter_max", "Rebroadcasts wait a random time up to this.", "100 ms"}, {0, 10},
              c.jitter_max);
  io.duration({"retry_period", "Between two discoveries of one destination.", "5 s"}, {1e-3, 3600},
              c.retry_period);
  io.number({"retry_jitter",
             "Largest share of retry_period by which a repeated discovery comes early, at random.",
             "0.25"},
            "1", {0, 1}, c.retry_jitter);
  io.count({"retries", "Discoveries in all before a destination is given up.", "3"}, 1, 100,
           c.retries);
  io.number({"acceptance",
             "Later copies of an ant are accepted with at most this times the fewest hops.", "1.5"},
            "1", {1, 100}, c.acceptance);
  io.flag({"accept_anywhere",
           "Whether every node accepts later copies; else only the destination does.", "true"},
          c.accept_anywhere);
  io.count({"hop_limit", "Hops after which ants, floods and messages are dropped.", "30"}, 1, 100,
           c.hop_limit);
  io.count({"buffer_limit", "Messages that may wait for one route or next hop.", "64"}, 0,
           1'000'000, c.buffer_limit);
  io.duration({"buffer_age", "Longest wait of a message for a route.", "10 s"}, {1e-3, 3600},
              c.buffer_age);
  hop_keys(io, c, status);
}

}  // namespace

RoutingConfig read_routing(Mapping& in, TransmitStatus status) {
  const Key key{"routing",
                "How messages find their way over several hops: ant routing, with these keys; or "
                "`none`: straight to the MAC, one hop."};
  RoutingConfig config;
  if (in.has_scalar(key.name)) {
    config.algorithm = in.choice(key, kNoRouting, Algorithm::kNone);
    return config;
  }
  Mapping ants = in.mapping(key);
  FieldReader reader(ants);
  routing_keys(reader, config, status);
  ants.finish();
  return config;
}

void write_routing(Writer& out, const RoutingConfig& config, TransmitStatus status) {
  if (config.algorithm == Algorithm::kNone) return out.text("routing", kNoRouting[0].name);
  RoutingConfig copy = config;
  FieldWriter writer(out);
  out.open("routing");
  routing_keys(writer, copy, status);
  out.close();
}

}  // namespace hal::description
