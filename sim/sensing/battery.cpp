#include "sim/sensing/battery.h"

namespace sim::sensing {
namespace {

class Gauge final : public hal::node::devices::Sensor {
 public:
  Gauge(const hal::node::devices::Battery& battery, const SensorSite& site)
      : battery_(battery), site_(site) {}

  hal::Channel describe() const override { return battery_.describe(); }

  std::optional<std::vector<double>> sample(hal::Time at) override {
    const hal::node::devices::Discharge now = site_.battery();
    if (at > read_at_) {
      current_ = (now.coulombs() - coulombs_) / hal::to_seconds(at - read_at_);
      coulombs_ = now.coulombs();
      read_at_ = at;
    }
    return std::vector{now.charge(), now.open_voltage() - now.resistance() * current_, current_,
                       now.energy(), now.capacity()};
  }

 private:
  hal::node::devices::Battery battery_;
  SensorSite site_;
  double current_ = 0;   ///< A; mean before the last reading
  double coulombs_ = 0;  ///< A s, up to the last reading
  hal::Time read_at_{};
};

}  // namespace

std::unique_ptr<hal::node::devices::Sensor> simulated(const hal::node::devices::Battery& battery,
                                                      const SensorSite& site) {
  return std::make_unique<Gauge>(battery, site);
}

}  // namespace sim::sensing
