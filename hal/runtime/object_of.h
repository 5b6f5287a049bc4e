#pragma once

#include "hal/api/real_world_object.h"
#include "hal/api/robot.h"
#include "hal/runtime/agent_context.h"
#include "hal/runtime/network_object.h"

namespace hal::runtime {

/// What motes and robots share, on top of an AgentContext. `Interface` is Mote or Robot.
template <class Interface>
class ObjectOf : public Interface {
 public:
  explicit ObjectOf(AgentContext& context) : context_(context), network_(context) {}

  AgentId id() const override;
  std::string_view name() const override;
  Time now() const override;
  Duration control_period() const override;
  std::string_view air_interface() const override;
  std::optional<AgentId> address_of(std::string_view name) const override;
  std::optional<std::string_view> name_of(AgentId agent) const override;
  Result<MessageId> send(AgentId destination, std::string_view topic,
                         std::span<const std::uint8_t> payload) override;
  Network& network() override;
  const Network& network() const override;
  Result<void> set_timer(TimerId id, Time at) override;
  std::span<const Channel> channels() const override;
  Result<std::span<const double>> reading(std::string_view channel) const override;
  Result<Vec2> relative_position(AgentId other) const override;
  Result<double> battery() const override;
  Result<double> battery_energy() const override;
  Result<double> battery_capacity() const override;
  void set_radio(bool on) override;
  RandomStream& random() override;
  void state(std::string_view name) override;
  void record(std::string_view name, double value) override;
  void log(log::Level level, std::string_view text) override;

 protected:
  AgentContext& context() const { return context_; }

 private:
  Result<double> of_battery(std::size_t value) const;

  AgentContext& context_;
  NetworkObject network_;
};

using MoteObject = ObjectOf<Mote>;
extern template class ObjectOf<Mote>;
extern template class ObjectOf<Robot>;

}  // namespace hal::runtime
