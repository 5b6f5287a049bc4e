// Laws of propagation against robot_rssi_2019.csv: RSSI of a robot on land and of a boat at sea, by
// bins of distance. Fitted are one constant for each radio (cables, set power), the reflection
// coefficient, and the exponent of log_distance; nothing else. docs/robot_rssi_2019.md has the
// table.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "sim/radio/channel/antenna.h"
#include "sim/radio/channel/log_distance.h"
#include "sim/radio/channel/power_law.h"
#include "sim/radio/channel/two_ray_ground.h"
#include "sim/radio/channel/two_ray_interference.h"
#include "tests/analytic/radio/peer.h"

namespace sim::radio::test {
namespace {

constexpr double kReceiverHeight = 2;  // m

struct Bin {
  double low, high;  // m
  double weight;
  double measured;  // dBm
};

/// One radio with one height of the transmitter in one place.
struct Setting {
  double ghz, height;
  std::string where;
  std::vector<Bin> bins{};

  hal::Metres wavelength() const { return hal::Metres{0.299792458 / ghz}; }
  /// Published vertical beam width. rad
  double beam() const { return (ghz < 3 ? 30 : 15) * 3.14159265358979323846 / 180; }
  /// Set power and gains of both antennas. dBm
  double radiated() const { return ghz < 3 ? 18 + 2 * 5 : 16 + 2 * 7; }
};

std::vector<Setting> settings_in(const std::string& where) {
  std::vector<Setting> all;
  for (auto& row : read_peer("robot_rssi_2019.csv")) {
    if (row["where"] != where) continue;
    const double ghz = std::stod(row["freq_GHz"]), height = std::stod(row["h_tx_m"]);
    if (all.empty() || all.back().ghz != ghz || all.back().height != height)
      all.push_back({ghz, height, where});
    all.back().bins.push_back({std::stod(row["d_lo"]), std::stod(row["d_hi"]), std::stod(row["n"]),
                               std::stod(row["mean_dBm"])});
  }
  return all;
}

using Law = std::function<std::unique_ptr<const PathLoss>(const Setting&)>;

/// What the law leaves, averaged in dB over the bin, as RSSI is.
double mean_over(const Bin& bin, const Setting& setting, const PathLoss& law) {
  constexpr int kPlaces = 50;
  double sum = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const double d = bin.low + (bin.high - bin.low) * (i + 0.5) / kPlaces;
    const Site from({0, 0, 0}, setting.height), to({d, 0, 0}, kReceiverHeight);
    sum += 10 * std::log10(law.after(hal::Milliwatts{1}, Path(from, to)).value);
  }
  return setting.radiated() + sum / kPlaces;
}

double rms(const std::vector<std::pair<double, double>>& weighted) {
  double squares = 0, weights = 0;
  for (const auto& [weight, error] : weighted) squares += weight * error * error, weights += weight;
  return std::sqrt(squares / weights);
}

struct Fit {
  double all = 0;                  // n-weighted rms, dB
  std::vector<double> of_setting;  // dB
  std::vector<double> constants;   // of each setting's radio, dB
};

/// The law with the best constant for each radio.
Fit fit(const std::vector<Setting>& settings, const Law& law) {
  Fit result;
  std::vector<std::vector<std::pair<double, double>>> errors;
  for (const Setting& setting : settings) {
    const auto loss = law(setting);
    auto& own = errors.emplace_back();
    for (const Bin& bin : setting.bins)
      own.emplace_back(bin.weight, bin.measured - mean_over(bin, setting, *loss));
  }
  std::vector<std::pair<double, double>> together;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    double sum = 0, weights = 0;
    for (std::size_t j = 0; j < settings.size(); ++j) {
      if (settings[j].ghz != settings[i].ghz) continue;
      for (const auto& [weight, error] : errors[j]) sum += weight * error, weights += weight;
    }
    result.constants.push_back(sum / weights);
    auto own = errors[i];
    for (auto& [weight, error] : own) error -= sum / weights;
    result.of_setting.push_back(rms(own));
    together.insert(together.end(), own.begin(), own.end());
  }
  result.all = rms(together);
  return result;
}

Law friis() {
  return [](const Setting& s) { return std::make_unique<PowerLaw>(s.wavelength(), 2); };
}
Law crossover() {
  return
      [](const Setting& s) { return std::make_unique<TwoRayGround>(s.wavelength(), *kFlatGround); };
}
Law log_distance(double exponent) {
  return [exponent](const Setting&) {
    return std::make_unique<LogDistance>(LogDistanceConfig{.exponent = exponent});
  };
}
Law two_rays(double reflection) {
  return [reflection](const Setting& s) {
    return std::make_unique<TwoRayInterference>(s.wavelength(), reflection, *kFlatGround);
  };
}

struct Best {
  double parameter;
  Fit fit;
};
/// The parameter in steps of 0.01 with the least residual of all settings together.
Best best(const std::vector<Setting>& settings, Law (*law)(double), int low, int high) {
  Best result{0, {1e9, {}, {}}};
  for (int i = low; i <= high; ++i) {
    const Fit one = fit(settings, law(i / 100.0));
    if (one.all < result.fit.all) result = {i / 100.0, one};
  }
  return result;
}

/// The figures of docs/robot_rssi_2019.md: n-weighted rms of all settings, and of each. dB
void expect(const Fit& fit, double all, const std::vector<double>& of_setting) {
  constexpr double kRounding = 0.0051;
  EXPECT_NEAR(fit.all, all, kRounding);
  ASSERT_EQ(fit.of_setting.size(), of_setting.size());
  for (std::size_t i = 0; i < of_setting.size(); ++i)
    EXPECT_NEAR(fit.of_setting[i], of_setting[i], kRounding) << i;
}

/// Index of the bin that lies deepest below Friis' law, measured or by a law.
template <class Level>
std::size_t deepest(const Setting& setting, Level level) {
  const auto free_space = friis()(setting);
  std::vector<double> above;
  for (const Bin& bin : setting.bins)
    above.push_back(level(bin) - mean_over(bin, setting, *free_space));
  return static_cast<std::size_t>(std::ranges::min_element(above) - above.begin());
}

TEST(RobotRssi2019, TwoRaysWithPhaseFitTheSea) {
  const auto sea = settings_in("sea");
  ASSERT_EQ(sea.size(), 3u);
  const Best rays = best(sea, two_rays, -100, 0);
  for (const double residual : rays.fit.of_setting) EXPECT_LE(residual, 1.6);
  EXPECT_NEAR(rays.parameter, -0.58, 1e-9);
  expect(rays.fit, 1.34, {1.24, 1.26, 1.50});
  EXPECT_NEAR(rays.fit.constants[0], -13.1, 0.051);  // dB, at 2.412 GHz
  EXPECT_NEAR(rays.fit.constants[1], -7.4, 0.051);   // dB, at 5.24 GHz
  EXPECT_EQ(rays.fit.constants[1], rays.fit.constants[2]) << "one radio";
}

/// A law whose direct and reflected rays have the vertical beams of both antennas, level.
class WithBeams final : public PathLoss {
 public:
  WithBeams(const Setting& setting, double reflection)
      : rays_(setting.wavelength(), reflection, *kFlatGround),
        sender_(AntennaPattern(beam(setting)), {1, 0, 0, 0}),
        receiver_(AntennaPattern(beam(setting)), {0, 0, 0, 1}) {}

  hal::Milliwatts after(hal::Milliwatts power, const Path& path) const override {
    Site from = path.from, to = path.to;
    from.directed = &sender_;
    to.directed = &receiver_;
    const hal::Vec3 way = to.antenna() - from.antenna();
    const double gain = sender_.towards(way) * receiver_.towards(-1 * way);
    return gain * rays_.after(power, Path(from, to));
  }
  double reach(hal::Milliwatts power, hal::Milliwatts least) const override {
    return rays_.reach(power, least);
  }

 private:
  static BeamAntenna beam(const Setting& setting) {
    return {.width = 6, .height = setting.beam(), .back = hal::Decibels{100}};
  }
  TwoRayInterference rays_;
  DirectedAntenna sender_, receiver_;
};

Law rays_with_beams(double reflection) {
  return [reflection](const Setting& s) { return std::make_unique<WithBeams>(s, reflection); };
}

TEST(RobotRssi2019, VerticalBeamsChangeLittleOverTheSea) {
  const Best rays = best(settings_in("sea"), rays_with_beams, -100, 0);
  EXPECT_NEAR(rays.parameter, -0.58, 1e-9);
  expect(rays.fit, 1.33, {1.19, 1.13, 1.60});
}

TEST(RobotRssi2019, TheOtherLawsDoNotFitTheSea) {
  const auto sea = settings_in("sea");
  expect(fit(sea, friis()), 2.98, {1.85, 3.33, 3.51});
  expect(fit(sea, crossover()), 2.90, {1.45, 3.33, 3.51});
  const Best slope = best(sea, log_distance, 100, 500);
  EXPECT_NEAR(slope.parameter, 1.92, 1e-9);
  expect(slope.fit, 2.96, {2.04, 3.18, 3.49});
}

TEST(RobotRssi2019, TheSeasNullIsWhereTwoRaysHaveIt) {
  const double reflection = best(settings_in("sea"), two_rays, -100, 0).parameter;
  for (const Setting& setting : settings_in("sea")) {
    if (setting.ghz < 3)
      continue;  // At 2.412 GHz and 2 m there are three bins to the null at 64 m.
    const auto rays = two_rays(reflection)(setting);
    const auto measured = deepest(setting, [](const Bin& bin) { return bin.measured; });
    const auto expected =
        deepest(setting, [&](const Bin& bin) { return mean_over(bin, setting, *rays); });
    EXPECT_LE(std::max(measured, expected) - std::min(measured, expected), 1u)
        << setting.height << " m";
  }
}

TEST(RobotRssi2019, OnLandTwoRaysFitLessWellAndTheOthersWorse) {
  const auto land = settings_in("land");
  ASSERT_EQ(land.size(), 3u);
  const Best rays = best(land, two_rays, -100, 100);
  EXPECT_NEAR(rays.parameter, -0.55, 1e-9);
  expect(rays.fit, 2.11, {1.91, 2.04, 2.37});
  expect(fit(land, friis()), 3.28, {3.38, 3.36, 3.07});
  expect(fit(land, crossover()), 3.19, {3.14, 3.35, 3.07});
  const Best slope = best(land, log_distance, 100, 500);
  EXPECT_NEAR(slope.parameter, 1.90, 1e-9);
  expect(slope.fit, 3.26, {3.46, 3.14, 3.14});
}

}  // namespace
}  // namespace sim::radio::test
