#include "sim/sensing/bumper.h"

namespace sim::sensing {
namespace {

class SimulatedBumper final : public hal::node::devices::Sensor {
 public:
  SimulatedBumper(const hal::node::devices::Bumper& bumper, const SensorSite& site)
      : bumper_(bumper), site_(site) {}

  hal::Channel describe() const override { return bumper_.describe(); }

  std::optional<std::vector<double>> sample(hal::Time) override {
    const physics::Contacts& contacts = site_.world.contacts(site_.agent);
    const std::uint64_t touched = contacts.walls.steps + contacts.bodies.steps;
    const bool pressed = touched > touched_;
    touched_ = touched;
    return std::vector{pressed ? 1.0 : 0.0};
  }

 private:
  hal::node::devices::Bumper bumper_;
  SensorSite site_;
  std::uint64_t touched_ = 0;  ///< Physics steps with contact, at the last reading.
};

}  // namespace

std::unique_ptr<hal::node::devices::Sensor> simulated(const hal::node::devices::Bumper& bumper,
                                                      const SensorSite& site) {
  return std::make_unique<SimulatedBumper>(bumper, site);
}

}  // namespace sim::sensing
