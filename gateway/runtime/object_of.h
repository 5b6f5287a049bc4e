#pragma once

#include "gateway/runtime/agent_context.h"
#include "gateway/runtime/network_object.h"
#include "hal/api/real_world_object.h"
#include "hal/api/robot.h"

namespace gateway::runtime {

/// The common part of motes and robots, on an AgentContext. `Interface` is Mote or Robot.
template <class Interface>
class ObjectOf : public Interface {
 public:
  explicit ObjectOf(AgentContext& context) : context_(context), network_(context) {}

  hal::AgentId id() const override;
  std::string_view name() const override;
  hal::Time now() const override;
  hal::Duration control_period() const override;
  std::string_view air_interface() const override;
  std::optional<hal::AgentId> address_of(std::string_view name) const override;
  std::optional<std::string_view> name_of(hal::AgentId agent) const override;
  hal::Result<hal::MessageId> send(hal::AgentId destination, std::string_view topic,
                                   std::span<const std::uint8_t> payload,
                                   const hal::SendOptions& options = {}) override;
  hal::Network& network() override;
  const hal::Network& network() const override;
  hal::Result<void> set_timer(hal::TimerId id, hal::Time at) override;
  std::span<const hal::Channel> channels() const override;
  hal::Result<std::span<const double>> reading(std::string_view channel) const override;
  hal::Result<hal::Vec2> relative_position(hal::AgentId other) const override;
  hal::Result<double> battery() const override;
  hal::Result<double> battery_energy() const override;
  hal::Result<double> battery_capacity() const override;
  void set_radio(bool on) override;
  hal::RandomStream& random() override;
  void state(std::string_view name) override;
  void record(std::string_view name, double value) override;
  void log(hal::log::Level level, std::string_view text) override;

 protected:
  AgentContext& context() const { return context_; }

 private:
  hal::Result<double> of_battery(std::size_t value) const;

  AgentContext& context_;
  NetworkObject network_;
};

using MoteObject = ObjectOf<hal::Mote>;
extern template class ObjectOf<hal::Mote>;
extern template class ObjectOf<hal::Robot>;

}  // namespace gateway::runtime
