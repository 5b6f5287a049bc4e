#include "hal/robot/drivers/tmc200_protocol.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "hal/types/check.h"
#include "hal/types/math.h"

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;

std::string command(std::string_view text) { return fmt::format("{} \n", text); }

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Removes an integer and the blanks before it from the front.
bool take_number(std::string_view& text, int& number) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return error == std::errc{};
}

}  // namespace

Tmc200Protocol::Tmc200Protocol(const Tmc200Settings& settings,
                               const node::devices::RobotDescription& robot)
    : settings_(settings) {
  BARAKA_CHECK(robot.wheels.size() == radii_.size());
  for (std::size_t i = 0; i < radii_.size(); ++i) radii_[i] = robot.wheels[i].radius;
}

/// The controller accepts only whole rpm; speeds are fractions of that rounded value.
int Tmc200Protocol::full_scale_rpm() const {
  return static_cast<int>(std::lround(settings_.motor.max_speed * 60 / (2 * math::kPi)));
}

double Tmc200Protocol::unit() const {
  const double motor = full_scale_rpm() * 2 * math::kPi / 60 / kFullScale;
  return (settings_.motor.inverted ? -motor : motor) / settings_.motor.gear;
}

std::vector<std::string> Tmc200Protocol::set_up() const {
  std::vector<std::string> lines{command("SMODE 1"),
                                 command(fmt::format("SMZNM {}", settings_.cut_off / 10ms))};
  const int steps = 2 * settings_.motor.encoder_lines;
  for (std::size_t i = 0; i < radii_.size(); ++i) {
    const double way = 2 * math::kPi * radii_[i] / (settings_.motor.gear * steps);  // m
    const auto half_micrometres = std::clamp(std::lround(way / 0.5e-6), 1L, 1000L);
    lines.push_back(command(
        fmt::format("SENCO M{} {} {} {}", i + 1, steps, full_scale_rpm(), half_micrometres)));
  }
  lines.push_back(command("SSEND 1"));
  return lines;
}

std::string Tmc200Protocol::set_speeds(const std::vector<double>& wheels) const {
  Speeds speeds{};
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const double full = kFullScale;
    speeds[i] = static_cast<int>(std::lround(std::clamp(wheels[i] / unit(), -full, full)));
  }
  return command(fmt::format("SV {} {} {}", speeds[0], speeds[1], speeds[2]));
}

bool Tmc200Protocol::is_ok(std::string_view line) { return trimmed(line) == "OK"; }

Result<std::vector<double>> Tmc200Protocol::measured(std::string_view line) const {
  std::string_view rest = line;
  std::vector<double> wheels;
  bool good = rest.starts_with("V ");
  if (good) rest.remove_prefix(1);
  for (std::size_t i = 0; good && i < radii_.size(); ++i) {
    int speed = 0;
    // Measured speeds may exceed the full scale, but not twice the full scale.
    good = take_number(rest, speed) && std::abs(speed) <= 2 * kFullScale;
    wheels.push_back(speed * unit());
  }
  if (good) good = rest.empty() || rest.front() == ' ' || rest.front() == '\t';
  if (good) return wheels;
  return fail(Errc::kProtocol, fmt::format("'{:.60}' is not an answer to SV", line));
}

}  // namespace hal::robot::drivers
