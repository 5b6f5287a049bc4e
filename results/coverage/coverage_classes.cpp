#include "results/coverage/coverage_classes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "results/report/drawing.h"

namespace results::coverage {
namespace {

struct Rgb {
  double red, green, blue;
};
constexpr std::array<Rgb, 9> kViridis{{{68, 1, 84},
                                       {71, 44, 122},
                                       {59, 81, 139},
                                       {44, 113, 142},
                                       {33, 144, 141},
                                       {39, 173, 129},
                                       {92, 200, 99},
                                       {170, 220, 50},
                                       {253, 231, 37}}};

/// @param share  0 .. 1, from dark to light.
std::string colour_at(double share) {
  const double place = share * (kViridis.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(place), kViridis.size() - 2);
  const double part = place - static_cast<double>(low);
  const auto mix = [part](double a, double b) {
    return static_cast<int>(std::lround(a + part * (b - a)));
  };
  const Rgb &a = kViridis.at(low), &b = kViridis.at(low + 1);
  return fmt::format("#{:02x}{:02x}{:02x}", mix(a.red, b.red), mix(a.green, b.green),
                     mix(a.blue, b.blue));
}

void colour(std::vector<Classes::One>& all) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double most = std::max<double>(1, static_cast<double>(all.size()) - 1);
    all[i].colour = colour_at(static_cast<double>(i) / most);
  }
}

/// Classes 5 wide from `low` to `high`; what lies beyond is in the first or last one.
struct Steps {
  static constexpr double kWidth = 5;
  double low;
  int count;

  std::size_t of(double value) const {
    const double place = std::floor((value - low) / kWidth);
    return static_cast<std::size_t>(std::clamp(place, 0.0, count - 1.0));
  }
  std::vector<Classes::One> all(const char* unit) const {
    std::vector<Classes::One> classes;
    for (int i = 0; i < count; ++i) {
      const double from = low + i * kWidth, to = from + kWidth;
      classes.push_back({i == 0           ? fmt::format("below {:g} {}", to, unit)
                         : i == count - 1 ? fmt::format("{:g} {} and more", from, unit)
                                          : fmt::format("{:g} to {:g} {}", from, to, unit),
                         {}});
    }
    return classes;
  }
};

constexpr Steps kRssiSteps{-95, 13};  // dBm
constexpr Steps kSnrSteps{-5, 15};    // dB

Classes stepped(const char* title, const Steps& steps, const char* unit,
                const std::function<double(const Spot&)>& value) {
  return {title, steps.all(unit),
          [steps, value](const Spot& spot) { return steps.of(value(spot)); }};
}

Classes best_of(const Coverage& map) {
  Classes classes{"best access point", {}, [](const Spot& spot) { return spot.best; }};
  for (std::size_t i = 0; i < map.transmitters.size(); ++i)
    classes.all.push_back({map.transmitters[i].name, report::colour_of(static_cast<int>(i))});
  return classes;
}

Classes rates_of_map(const Coverage& map) {
  Classes classes{fmt::format("expected rate, {} bytes", map.bytes), {}, {}};
  for (const double rate : map.rates) classes.all.push_back({fmt::format("{:g} Mb/s", rate), {}});
  classes.of = [rates = map.rates](const Spot& spot) {
    const auto found = std::ranges::find(rates, spot.rate.value / 1e6);
    return static_cast<std::size_t>(found - rates.begin());
  };
  return classes;
}

Classes unlimited(const Coverage& map, Layer layer) {
  switch (layer) {
    case Layer::kRssi:
      return stepped("RSSI", kRssiSteps, "dBm", [](const Spot& spot) { return spot.rssi.value; });
    case Layer::kSnr:
      return stepped("SNR", kSnrSteps, "dB", [](const Spot& spot) { return spot.snr.value; });
    case Layer::kBest:
      return best_of(map);
    case Layer::kRate:
      break;
  }
  return rates_of_map(map);
}

}  // namespace

Classes classes_of(const Coverage& map, Layer layer) {
  Classes classes = unlimited(map, layer);
  if (layer != Layer::kBest) colour(classes.all);
  const std::size_t none = classes.all.size();
  classes.of = [inner = classes.of, none, least = map.sensitivity](const Spot& spot) {
    return spot.rssi < least ? none : inner(spot);
  };
  return classes;
}

std::vector<double> shares_of(const Coverage& map, const Classes& classes) {
  std::vector<double> shares(classes.all.size() + 1, 0);
  for (const Spot& spot : map.spots)
    shares[classes.of(spot)] += 1 / static_cast<double>(map.spots.size());
  return shares;
}

}  // namespace results::coverage
