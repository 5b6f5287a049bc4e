#include "baraka/run/topics/teleop_velocities.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace baraka::run::topics {
namespace {

constexpr std::size_t kBytesOfValue = 8, kValues = 3;

}  // namespace

std::vector<std::uint8_t> to_bytes(const hal::Twist2& twist) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(kValues * kBytesOfValue);
  for (const double value : {twist.vx, twist.vy, twist.omega}) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (std::size_t i = 0; i < kBytesOfValue; ++i) {
      bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
    }
  }
  return bytes;
}

hal::Twist2 twist_of(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != kValues * kBytesOfValue) {
    throw std::runtime_error(fmt::format("a velocity from outside has {} bytes instead of {}",
                                         bytes.size(), kValues * kBytesOfValue));
  }
  std::array<double, kValues> values{};
  for (std::size_t k = 0; k < kValues; ++k) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < kBytesOfValue; ++i) {
      bits |= std::uint64_t{bytes[k * kBytesOfValue + i]} << (8 * i);
    }
    values[k] = std::bit_cast<double>(bits);
    if (std::isfinite(values[k])) continue;
    throw std::runtime_error(fmt::format("a velocity from outside is {}", values[k]));
  }
  return {values[0], values[1], values[2]};
}

TeleopVelocities::TeleopVelocities(sim::OutsideInput& input, const std::string& agent)
    : input_(input), agent_(agent), door_("cmd_vel of " + agent) {
  input_.open(door_, [this](std::span<const std::uint8_t> bytes) {
    last_ = {.twist = twist_of(bytes), .number = last_ ? last_->number + 1 : 1};
  });
}

void TeleopVelocities::listen(gateway::inspection::InspectionParticipant& participant) {
  reader_ = std::make_unique<gateway::inspection::TwistReader>(
      participant, agent_,
      [this](const Command& command) { input_.put(door_, to_bytes(command.twist)); });
}

}  // namespace baraka::run::topics
