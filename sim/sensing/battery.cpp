#include "sim/sensing/battery.h"

namespace sim::sensing {
namespace {

class SimulatedBattery final : public hal::devices::Sensor {
 public:
  SimulatedBattery(const hal::devices::Battery& battery, const SensorSite& site)
      : battery_(battery), site_(site), discharge_(battery) {}

  hal::Channel describe() const override { return battery_.describe(); }

  std::optional<std::vector<double>> sample(hal::Time at) override {
    if (at > read_at_) {
      const double drawn = drawn_until(at);
      discharge_.draw(drawn - drawn_, at - read_at_);
      drawn_ = drawn;
      read_at_ = at;
    }
    if (const double taken = site_.taken_energy ? site_.taken_energy() : 0; taken != taken_) {
      discharge_.take(taken - taken_);
      taken_ = taken;
    }
    return std::vector{discharge_.charge(), discharge_.voltage(), discharge_.current()};
  }

 private:
  /// J since time 0.
  double drawn_until(hal::Time at) const {
    return battery_.idle_power * hal::to_seconds(at - hal::Time{}) +
           site_.world.energy(site_.agent).motor_input + site_.radio_energy(battery_.radio);
  }

  hal::devices::Battery battery_;
  SensorSite site_;
  hal::devices::Discharge discharge_;
  double drawn_ = 0;  ///< J until it was read last.
  double taken_ = 0;  ///< J, likewise.
  hal::Time read_at_{};
};

}  // namespace

std::unique_ptr<hal::devices::Sensor> simulated(const hal::devices::Battery& battery,
                                                const SensorSite& site) {
  return std::make_unique<SimulatedBattery>(battery, site);
}

}  // namespace sim::sensing
