#include "hal/description/routing_section.h"

#include "hal/description/fields.h"

namespace hal::description {
namespace {

using routing::RoutingConfig;

/// How the router finds out for itself whether a hop works.
template <class Io>
void hop_keys(Io& io, RoutingConfig& c, TransmitStatus status) {
  if (status == TransmitStatus::kReported) {
    for (const char* key : {"ack_timeout", "ack_attempts", "hello_period", "hello_limit"}) {
      io.unused(key, "is not used with 'link: mac', which reports what becomes of each frame");
    }
    return;
  }
  io.duration("ack_timeout", {1e-4, 10}, c.ack_timeout);
  io.count("ack_attempts", 1, 16, c.ack_attempts);
  io.duration("hello_period", {1e-3, 3600}, c.hello_period);
  io.count("hello_limit", 1, 100, c.hello_limit);
}

template <class Io>
void routing_keys(Io& io, RoutingConfig& c, TransmitStatus status) {
  io.number("beta", "1", {1, 100}, c.beta);
  io.number("direct_weight", "1", {1, 1e12}, c.direct_weight);
  io.duration("jitter_max", {0, 10}, c.jitter_max);
  io.duration("retry_period", {1e-3, 3600}, c.retry_period);
  io.number("retry_jitter", "1", {0, 1}, c.retry_jitter);
  io.count("retries", 1, 100, c.retries);
  io.number("acceptance", "1", {1, 100}, c.acceptance);
  io.flag("accept_anywhere", c.accept_anywhere);
  io.count("hop_limit", 1, 100, c.hop_limit);
  io.count("buffer_limit", 0, 1'000'000, c.buffer_limit);
  io.duration("buffer_age", {1e-3, 3600}, c.buffer_age);
  hop_keys(io, c, status);
}

}  // namespace

RoutingConfig read_routing(Mapping in, TransmitStatus status) {
  RoutingConfig config;
  FieldReader reader(in);
  routing_keys(reader, config, status);
  in.finish();
  return config;
}

void write_routing(Writer& out, const RoutingConfig& config, TransmitStatus status) {
  RoutingConfig copy = config;
  FieldWriter writer(out);
  out.open("routing");
  routing_keys(writer, copy, status);
  out.close();
}

}  // namespace hal::description
