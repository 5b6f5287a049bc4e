#include "hal/description/routing_section.h"

#include "hal/description/fields.h"

namespace hal::description {
namespace {

using routing::RoutingConfig;

template <class Io>
void routing_keys(Io& io, RoutingConfig& c) {
  io.number("beta", "1", {1, 100}, c.beta);
  io.number("direct_weight", "1", {1, 1e12}, c.direct_weight);
  io.duration("jitter_max", {0, 10}, c.jitter_max);
  io.duration("retry_period", {1e-3, 3600}, c.retry_period);
  io.count("retries", 1, 100, c.retries);
  io.number("acceptance", "1", {1, 100}, c.acceptance);
  io.flag("accept_anywhere", c.accept_anywhere);
  io.count("hop_limit", 1, 100, c.hop_limit);
  io.count("buffer_limit", 0, 1'000'000, c.buffer_limit);
  io.duration("buffer_age", {1e-3, 3600}, c.buffer_age);
}

}  // namespace

RoutingConfig read_routing(Mapping in) {
  RoutingConfig config;
  FieldReader reader(in);
  routing_keys(reader, config);
  in.finish();
  return config;
}

void write_routing(Writer& out, const RoutingConfig& config) {
  RoutingConfig copy = config;
  FieldWriter writer(out);
  out.open("routing");
  routing_keys(writer, copy);
  out.close();
}

}  // namespace hal::description
