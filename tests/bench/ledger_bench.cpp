// What the ledger of the air costs: packets that Cyclone DDS sent (tests/unit/sim/air/ledger),
// again and again, each with two retries, to so many radios.
//
//   ledger_bench [radios=39] [rounds=200]
//
// Prints "key: value" lines; a frame's cost holds that of its receptions.

#include <fmt/core.h>
#include <sys/resource.h>

#include <cstdlib>

#include "sim/air/ledger.h"
#include "tests/unit/sim/air/ledger/replay.h"

namespace {

using namespace sim;

double user_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// A frame and its retries, from the interface of its sender to those of the receivers.
std::uint64_t send(sim::air::Ledger& ledger, const sim::air::test::Packet& packet, std::uint64_t id,
                   std::uint16_t radios) {
  constexpr int kTransmissions = 3;
  const hal::Time at{std::chrono::milliseconds{id}};
  sim::radio::Frame frame;
  frame.transmitter = packet.source;
  frame.receiver = packet.destination;
  frame.ethertype = packet.type;
  // A payload of its own, as if it came by an interface.
  frame.payload = std::make_shared<const hal::Bytes>(*packet.payload);
  frame.air_length = static_cast<std::uint32_t>(8 * (packet.payload->size() + 36));
  frame.airtime = std::chrono::microseconds{20 + packet.payload->size() / 7};
  ledger.on_entered(
      at, packet.source,
      {.destination = packet.destination, .ethertype = packet.type, .payload = frame.payload});
  for (int i = 0; i < kTransmissions; ++i) {
    frame.id = id * kTransmissions + static_cast<std::uint64_t>(i);
    frame.retry = i > 0;
    ledger.on_frame_start(at, frame);
    for (std::uint16_t radio = 1; radio <= radios + 1; ++radio) {
      const hal::AgentId receiver{radio};
      if (receiver != packet.source)
        ledger.on_reception(at, frame, receiver, hal::Verdict::kDelivered, -60);
    }
  }
  if (packet.destination != hal::kEveryone)
    ledger.on_left(at, packet.destination,
                   {.source = packet.source,
                    .destination = packet.destination,
                    .payload = frame.payload,
                    .ethertype = packet.type});
  return kTransmissions;
}

}  // namespace

int main(int argc, char** argv) {
  const auto radios = static_cast<std::uint16_t>(argc > 1 ? std::atoi(argv[1]) : 39);
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 200;
  const auto packets = sim::air::test::read_capture("cyclone_v4");
  sim::air::Ledger ledger;
  std::uint64_t frames = 0;
  std::uint64_t id = 0;
  const double start = user_seconds();
  for (int round = 0; round < rounds; ++round) {
    for (const auto& packet : packets) frames += send(ledger, packet, ++id, radios);
  }
  const double spent = user_seconds() - start;
  fmt::print("frames: {}\nradios: {}\nus_per_frame: {:.3f}\n", frames, radios,
             1e6 * spent / static_cast<double>(frames));
  return 0;
}
