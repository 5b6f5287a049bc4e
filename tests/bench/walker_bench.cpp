// How long a datagram is looked at before Fast DDS gets it: the filter of a participant, with the
// walker in it, over those of an exchange as they were recorded.
//
//   walker_bench [ROUNDS]

#include <fmt/core.h>

#include <chrono>
#include <string>

#include "gateway/guard/datagram_filter.h"
#include "hal/rtps/walk.h"
#include "tests/unit/hal/rtps/datagrams.h"

namespace {

/// Whether a datagram carries a sample of a user's topic: a Step or a Reply, not discovery.
bool is_of_an_exchange(const hal::rtps::Datagram& datagram) {
  hal::rtps::Walk walk(hal::rtps::octets_of(datagram));
  while (const hal::rtps::Submessage* one = walk.next()) {
    if (one->kind == hal::rtps::SubmessageKind::kData && !one->writer().is_builtin()) return true;
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::stoi(argv[1]) : 100'000;
  std::vector<hal::rtps::Datagram> datagrams;
  for (hal::rtps::Datagram& one : hal::rtps::recorded("fast_dds")) {
    if (is_of_an_exchange(one)) datagrams.push_back(std::move(one));
  }
  gateway::guard::DatagramFilter filter(
      {.networks = gateway::guard::networks_of({"127.0.0.1"}), .is_star = true});
  int good = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < rounds; ++i) {
    for (const hal::rtps::Datagram& one : datagrams) {
      good += filter.lets_in(hal::rtps::octets_of(one), {0x7f000001, one[19]}) ? 1 : 0;
    }
  }
  const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
  fmt::print("datagrams: {}\ngood: {}\nns: {:.1f}\n", datagrams.size(), good,
             took.count() / rounds / static_cast<double>(datagrams.size()));
}
