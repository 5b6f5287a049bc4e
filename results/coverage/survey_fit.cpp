#include "results/coverage/survey_fit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "hal/files/config/errors.h"
#include "hal/types/math.h"
#include "hal/types/random.h"
#include "results/coverage/mean_power.h"
#include "sim/radio/channel/wall_losses.h"
#include "sim/scenario/radio_section.h"

namespace results::coverage {
namespace {

using sim::agents::AgentConfig;
using sim::agents::SimulationConfig;
using sim::radio::MultiWallConfig;
using statistics::Observations;

constexpr const char* kConstant = "constant_loss";
constexpr const char* kExponent = "exponent";
constexpr const char* kCeilings = "ceiling_loss";
constexpr double kLowestExponent = 0.1, kHighestExponent = 8;
constexpr double kLowestConstant = -100, kHighestConstant = 300;  // dB

/// The law that the scenario has, for what is not fitted.
MultiWallConfig law_of(const SimulationConfig& config) {
  for (const auto& one : waves_of(config.radio)->propagation.chain)
    if (const auto* const law = std::get_if<MultiWallConfig>(&one)) return *law;
  return {};
}

std::string about_access_point(const SimulationConfig& config, const SurveyRow& row) {
  std::vector<std::string> names;
  for (const AgentConfig& agent : config.agents) names.push_back(agent.name);
  constexpr std::size_t kListed = 20;
  if (names.size() > kListed) names.resize(kListed);
  return fmt::format("{}: access_point: the scenario has no agent '{}'; it has {}",
                     row.access_point_place, row.access_point, fmt::join(names, ", "));
}

/// Paths of a survey in a world.
class Paths {
 public:
  explicit Paths(const SimulationConfig& config)
      : config_(config), power_(config), law_(law_of(config)) {
    const double wavelength = power_.waves().propagation.wavelength.value;
    at_one_metre_ = 20 * hal::math::log10(4 * hal::math::kPi / wavelength);
  }

  std::vector<sim::Material> materials() const { return power_.obstacles().materials(); }

  /// The row with all coefficients: constant, exponent, materials, ceilings.
  void add(const SurveyRow& row, Observations& data, std::vector<std::string>& mistakes) {
    const auto agent = std::ranges::find(config_.agents, row.access_point, &AgentConfig::name);
    if (agent == config_.agents.end()) {
      mistakes.push_back(about_access_point(config_, row));
      return;
    }
    const MeanPower::Emission emission = power_.emission_of(*agent);
    const hal::Vec3 from = emission.antenna, to = receiver_of(row);
    const hal::Vec3 way = to - from;
    const double metres = std::sqrt(hal::dot(way, way));
    if (metres == 0) {
      mistakes.push_back(fmt::format("{}: is at the antenna of '{}'", row.place, agent->name));
      return;
    }
    power_.obstacles().crossings(from, to, law_.gap, crossed_);
    std::vector<double> factors{1, 10 * hal::math::log10(metres)};
    factors.insert(factors.end(), crossed_.walls.begin(), crossed_.walls.end());
    factors.push_back(sim::radio::ceiling_factor(crossed_.ceilings, law_.ceiling_b));
    data.rows.push_back(std::move(factors));
    data.values.push_back(emission.towards(to).value - row.dbm - at_one_metre_);
  }

 private:
  hal::Vec3 receiver_of(const SurveyRow& row) const {
    hal::Vec3 place = sim::on(power_.ground(), {row.x, row.y});
    place.z += row.z.value_or(power_.waves().propagation.antenna_height.value);
    return place;
  }

  const SimulationConfig& config_;
  MeanPower power_;
  MultiWallConfig law_;
  double at_one_metre_;  ///< dB
  sim::WallCrossings crossed_;
};

/// Removes the coefficients of walls and ceilings that no row crosses.
void drop_uncrossed(Observations& data) {
  for (std::size_t j = data.names.size(); j-- > 2;) {
    if (std::ranges::any_of(data.rows, [j](const auto& row) { return row[j] != 0; })) continue;
    data.names.erase(data.names.begin() + static_cast<std::ptrdiff_t>(j));
    for (auto& row : data.rows) row.erase(row.begin() + static_cast<std::ptrdiff_t>(j));
  }
}

void ask_identified(const Observations& data) {
  if (data.rows.size() <= data.names.size()) {
    throw std::runtime_error(fmt::format("{} rows are too few for {} parameters: {}",
                                         data.rows.size(), data.names.size(),
                                         fmt::join(data.names, ", ")));
  }
  const auto names = statistics::unidentified(data);
  if (names.empty()) return;
  throw std::runtime_error(fmt::format(
      "the survey does not tell these parameters apart: {}; measure where their walls are crossed "
      "in other numbers or at other distances",
      fmt::join(names, ", ")));
}

Observations some_of(const Observations& data, std::span<const std::size_t> rows) {
  Observations some{data.names, {}, {}};
  for (const std::size_t row : rows) {
    some.rows.push_back(data.rows[row]);
    some.values.push_back(data.values[row]);
  }
  return some;
}

std::optional<HeldOut> hold_out(const Observations& data) {
  std::vector<std::size_t> order(data.rows.size());
  std::iota(order.begin(), order.end(), 0);
  hal::RandomStream random(1, "held out");
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
  const std::size_t half = order.size() / 2;
  const std::span<const std::size_t> all(order);
  const Observations fitted = some_of(data, all.first(half));
  const Observations held = some_of(data, all.subspan(half));
  if (fitted.rows.size() <= fitted.names.size() || !statistics::unidentified(fitted).empty())
    return std::nullopt;
  const auto fit = statistics::linear_fit(fitted);
  return HeldOut{half, held.rows.size(), statistics::rms_residual(fitted, fit),
                 statistics::rms_residual(held, fit)};
}

double within(const statistics::Coefficient& one, double low, double high) {
  if (one.value >= low && one.value <= high) return one.value;
  throw std::runtime_error(
      fmt::format("{}: the fit gives {:.3g}, which is not {:g} to {:g}: are "
                  "transmit powers, gains and places those of the survey?",
                  one.name, one.value, low, high));
}

/// Losses are not negative in a radio file.
hal::Decibels loss_of(const statistics::Coefficient& one, std::vector<std::string>& warnings) {
  if (one.value < 0) {
    warnings.push_back(
        fmt::format("{}: the fit gives {:.2f} dB; 0 dB is written", one.name, one.value));
  }
  return hal::Decibels{std::max(0.0, one.value)};
}

}  // namespace

Observations observations_of(const SimulationConfig& config, std::span<const SurveyRow> rows) {
  Paths paths(config);
  Observations data{{kConstant, kExponent}, {}, {}};
  for (const sim::Material& material : paths.materials()) data.names.push_back(material.name);
  data.names.emplace_back(kCeilings);
  std::vector<std::string> mistakes;
  for (const SurveyRow& row : rows) paths.add(row, data, mistakes);
  if (!mistakes.empty()) throw hal::files::config::ConfigErrors(mistakes);
  drop_uncrossed(data);
  return data;
}

SurveyFit fit_survey(const SimulationConfig& config, std::span<const SurveyRow> rows) {
  const Observations data = observations_of(config, rows);
  ask_identified(data);
  SurveyFit result{law_of(config), statistics::linear_fit(data), rows.size(), hold_out(data), {}};
  const auto& found = result.fit.coefficients;
  result.law.constant_loss = hal::Decibels{within(found[0], kLowestConstant, kHighestConstant)};
  result.law.exponent = within(found[1], kLowestExponent, kHighestExponent);
  for (std::size_t j = 2; j < found.size(); ++j) {
    const hal::Decibels loss = loss_of(found[j], result.warnings);
    if (found[j].name == kCeilings) {
      result.law.ceiling_loss = loss;
      continue;
    }
    auto& walls = result.law.walls;
    std::erase_if(walls, [&](const auto& wall) { return wall.material == found[j].name; });
    walls.push_back({found[j].name, loss});
  }
  return result;
}

std::string survey_text(const SurveyFit& fit) {
  std::string text = fmt::format("{:<16} {:>9}   95 % interval\n", "parameter", "value");
  for (const auto& one : fit.fit.coefficients) {
    text += fmt::format("{:<16} {:>9.3f}   {:.3f} to {:.3f}{}\n", one.name, one.value,
                        one.interval.low, one.interval.high, one.name == kExponent ? "" : " dB");
  }
  text +=
      fmt::format("{} rows, standard deviation of the residual {:.2f} dB\n", fit.rows, fit.fit.sd);
  if (fit.held_out) {
    text += fmt::format("fitted to {} of them: rms {:.2f} dB, and {:.2f} dB at the {} held out\n",
                        fit.held_out->fitted_rows, fit.held_out->fitted, fit.held_out->held,
                        fit.held_out->held_rows);
  }
  return text;
}

std::string survey_radio(const SimulationConfig& config, const SurveyFit& fit,
                         const std::string& what) {
  sim::radio::RadioConfig radio = config.radio;
  for (auto& law : waves_of(radio)->propagation.chain)
    if (sim::radio::is_law_of_distance(law)) law = fit.law;
  hal::files::config::Writer out;
  sim::scenario::FieldWriter io(out);
  sim::scenario::keys_of(io, radio);
  std::string head = fmt::format("# {}\n", what);
  const std::string text = survey_text(fit);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    head += "#   " + text.substr(begin, end - begin) + '\n';
    begin = end + 1;
  }
  return head + out.take();
}

}  // namespace results::coverage
