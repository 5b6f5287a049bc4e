#include <gtest/gtest.h>

#include <string>

#include "gateway/exchange/controller_process.h"
#include "hal/api/controller.h"
#include "hal/types/log.h"

namespace {

/// Drives slowly ahead.
class Driver : public hal::Controller {
 public:
  Driver(hal::Robot& robot, const hal::Parameters&) : robot_(robot) {}
  void step() override { [[maybe_unused]] const auto done = robot_.set_body_velocity({.vx = 0.2}); }

 private:
  hal::Robot& robot_;
};

int be_driver(int domain, const std::string& name) {
  const hal::ControllerKind kind{.name = "contract", .make_for_robot = hal::make_for_robot<Driver>};
  gateway::runtime::ControllerOptions options;
  options.agents = {"r0"};
  options.domain = domain;
  options.name = name;
  return static_cast<int>(gateway::exchange::run_controllers(kind, options));
}

}  // namespace

/// For the sanitizer: Fast DDS 2.9 deletes one of its own objects as its base class.
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier)
  return "new_delete_type_mismatch=0";
}

/// Tests, or the role of a Child: "driver DOMAIN NAME".
int main(int argc, char** argv) {
  if (argc > 3 && std::string(argv[1]) == "driver") return be_driver(std::stoi(argv[2]), argv[3]);
  hal::log::set_level(hal::log::Level::kError);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
