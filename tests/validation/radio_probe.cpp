// What the radio library computes, asked for in lines of words, one number per line:
//
//   per dsss|nist RATE BYTES SNR      packet error rate; bit/s, dB
//   two_ray DISTANCE HEIGHT HEIGHT    gain, dB; m
//   log_distance DISTANCE             gain, dB; 46.6777 dB at 1 m, exponent 3
//   shadowing LINK X                  gain, dB, from (0, 0) to (X, 0); sigma 6 dB, 20 m
//   rayleigh - LINK Y                 gain of a link of 50 m, its far end moved by Y m across
//   rician K LINK Y                   the same; K a ratio
//   nakagami M LINK Y                 the same

#include <cmath>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

#include "sim/radio/channel/log_distance.h"
#include "sim/radio/channel/nakagami.h"
#include "sim/radio/channel/rayleigh.h"
#include "sim/radio/channel/rician.h"
#include "sim/radio/channel/shadowing.h"
#include "sim/radio/channel/two_ray_ground.h"
#include "sim/radio/phy/error_model.h"
#include "sim/radio/phy/ofdm_error_model.h"
#include "sim/radio/phy/ofdm_mode.h"

namespace {

using namespace sim::radio;

constexpr hal::Metres kWavelength{299792458.0 / 2.412e9};
constexpr hal::Milliwatts kOne{1};

double decibels(double ratio) { return 10 * std::log10(ratio); }

double packet_errors(std::istream& words) {
  std::string model;
  double rate = 0, bytes = 0, snr = 0;
  words >> model >> rate >> bytes >> snr;
  const double sinr = std::pow(10, snr / 10);
  const hal::BitsPerSecond speed{rate};
  return 1 - (model == "dsss" ? success_probability(ErrorModel::kDsss, sinr, speed, 8 * bytes)
                              : ofdm_success_probability(sinr, ofdm_coding(speed), 8 * bytes));
}

double two_ray(std::istream& words) {
  double distance = 0, from = 0, to = 0;
  words >> distance >> from >> to;
  return decibels(TwoRayGround{kWavelength, *sim::kFlatGround}
                      .after(kOne, Path(Site({0, 0, 0}, from), Site({distance, 0, 0}, to)))
                      .value);
}

double log_distance(std::istream& words) {
  double distance = 0;
  words >> distance;
  const LogDistance loss{LogDistanceConfig{}};
  return decibels(loss.after(kOne, Path(Site({}), Site({distance, 0, 0}))).value);
}

/// Of link number n, its far end at a place.
double gain(const PathLoss& loss, std::uint64_t n, const hal::Vec3& to) {
  const std::uint64_t name = n * 0x9e3779b97f4a7c15u;
  const Site here({0, 0, 0}, 0, name), there(to, 0, ~name);
  return loss.after(kOne, Path(here, there, {})).value;
}

double shadowing(std::istream& words) {
  static const Shadowing loss(
      {.sigma = hal::Decibels{6}, .decorrelation_distance = hal::Metres{20}});
  std::uint64_t link = 0;
  double x = 0;
  words >> link >> x;
  return decibels(gain(loss, link, {x, 0, 0}));
}

double fading(const std::string& kind, std::istream& words) {
  double parameter = 0, across = 0;
  std::uint64_t link = 0;
  words >> parameter >> link >> across;
  const hal::Vec3 to{50, across, 0};
  if (kind == "rayleigh") return gain(RayleighFading({}, kWavelength), link, to);
  if (kind == "rician") {
    RicianConfig config;
    config.k = hal::Decibels{decibels(parameter)};
    return gain(RicianFading(config, kWavelength), link, to);
  }
  static std::map<double, NakagamiFading> made;
  NakagamiConfig config;
  config.m_near = parameter;
  return gain(made.try_emplace(parameter, config, kWavelength).first->second, link, to);
}

}  // namespace

int main() {
  std::cout.precision(17);
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string what;
    words >> what;
    double answer = 0;
    if (what == "per") {
      answer = packet_errors(words);
    } else if (what == "two_ray") {
      answer = two_ray(words);
    } else if (what == "log_distance") {
      answer = log_distance(words);
    } else if (what == "shadowing") {
      answer = shadowing(words);
    } else if (what == "rayleigh" || what == "rician" || what == "nakagami") {
      answer = fading(what, words);
    } else {
      words.setstate(std::ios::failbit);
    }
    if (words.fail()) {
      std::cerr << "not understood: " << line << '\n';
      return 1;
    }
    std::cout << answer << '\n';
  }
}
