#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "hal/types/math.h"

namespace sim::radio::test {

/// Times in us, of saturated stations that all send frames of 1500 bytes of payload; those of OFDM
/// in 5 GHz.
struct SlotTimes {
  double frame = 0;
  double answer = 0;
  double slot = 9, sifs = 16, difs = 34;
  int windows = 16;  ///< CWmin + 1.
  int doublings = 6;

  double success() const { return frame + sifs + answer + difs; }
  double collision() const { return frame + difs; }
};

/// Probability that a station sends in a slot when its frames collide with probability `p`, retries
/// are endless and the window doubles `doublings` times: G. Bianchi, "Performance Analysis of the
/// IEEE 802.11 Distributed Coordination Function", IEEE JSAC 18 (3), 2000, equation 7.
inline double transmission_probability(double p, const SlotTimes& times) {
  double sum = 0, power = 1;
  for (int i = 0; i < times.doublings; ++i, power *= 2 * p) sum += power;
  return 2 / (1 + times.windows + p * times.windows * sum);
}

/// Goodput in Mb/s by equations 7, 9 and 13 of the same, where a success takes one slot more.
inline double bianchi(int n, const SlotTimes& times) {
  double low = 0, high = 1;  // of the probability of a collision
  double tau = 0;
  for (int i = 0; i < 100; ++i) {
    const double p = (low + high) / 2;
    tau = transmission_probability(p, times);
    (1 - hal::math::pow(1 - tau, n - 1) > p ? low : high) = p;
  }
  const double none = hal::math::pow(1 - tau, n);
  const double one = n * tau * hal::math::pow(1 - tau, n - 1);
  return one * 12'000 /
         (none * times.slot + one * (times.success() + times.slot) +
          (1 - none - one) * times.collision());
}

/// When a station's backoff counter goes down.
enum class Counting : std::uint8_t {
  kInBusySlots,  ///< Also by one for each transmission of others, as in Bianchi's chain.
  kInIdleSlots,  ///< As in the standard; those who collided join after an ACK timeout.
};

/// The DCF slot by slot, without times of propagation.
class SlottedDcf {
 public:
  SlottedDcf(int n, const SlotTimes& times, Counting counting)
      : times_(times),
        counting_(counting),
        timeout_(counting == Counting::kInIdleSlots
                     ? static_cast<int>((times.sifs + times.slot + 20) / times.slot)
                     : 0),
        stations_(static_cast<std::size_t>(n)) {
    for (Station& one : stations_) one.counter = draw(one);
  }

  /// Goodput in Mb/s.
  double run(int transmissions) {
    double time = 0;
    int successes = 0;
    for (int i = 0; i < transmissions; ++i) {
      const int idle = slots_until_next();
      const std::vector<Station*> senders = senders_after(idle);
      const bool is_success = senders.size() == 1;
      for (Station* const one : senders) finish(*one, is_success);
      successes += is_success;
      time += idle * times_.slot + (is_success ? times_.success() : times_.collision());
      if (is_success && counting_ == Counting::kInBusySlots) time += times_.slot;
    }
    return 12e3 * successes / time;
  }

 private:
  struct Station {
    int stage = 0, counter = 0;
    int away = 0;  ///< Slots until its ACK timeout is over.
    int due() const { return away + counter; }
  };

  int draw(const Station& one) {
    return static_cast<int>(random_() % static_cast<unsigned>(times_.windows << one.stage));
  }

  int slots_until_next() const {
    const auto less = [](const Station& a, const Station& b) { return a.due() < b.due(); };
    return std::ranges::min_element(stations_, less)->due();
  }

  /// Lets the others count; a timeout that is interrupted is over with the frame that interrupts
  /// it.
  std::vector<Station*> senders_after(int idle) {
    std::vector<Station*> senders;
    for (Station& one : stations_) {
      if (one.due() == idle) {
        senders.push_back(&one);
      } else {
        one.counter -= std::max(0, idle - one.away) + (counting_ == Counting::kInBusySlots ? 1 : 0);
      }
      one.away = 0;
    }
    return senders;
  }

  void finish(Station& one, bool is_success) {
    one.stage = is_success ? 0 : std::min(one.stage + 1, times_.doublings);
    one.counter = draw(one);
    one.away = is_success ? 0 : timeout_;
  }

  std::mt19937 random_{1};
  SlotTimes times_;
  Counting counting_;
  int timeout_;  ///< ACK timeout: SIFS, a slot, and preamble and header of an OFDM frame
                 ///< (10.3.2.9).
  std::vector<Station> stations_;
};

inline double slotted_dcf(int n, const SlotTimes& times, Counting counting) {
  return SlottedDcf(n, times, counting).run(300'000);
}

}  // namespace sim::radio::test
