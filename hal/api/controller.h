#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hal/api/parameters.h"
#include "hal/api/real_world_object.h"
#include "hal/api/robot.h"
#include "hal/types/wants.h"

namespace hal {

/// The behaviour of one agent. The HAL calls it, one callback at a time, never re-entrant. It gets
/// its Mote& or Robot& in the constructor and keeps it for life. No mutable globals: in process all
/// agents would share them. A callback that throws ends the run; the message is reported.
class Controller {
 public:
  virtual ~Controller() = default;
  /// Once, before all other calls. In the simulator at time 0 or, with `control_phase: uniform`, at
  /// the agent's own phase of less than a control period: timers set here differ between agents.
  virtual void start() {}
  virtual void step() {}  ///< Once per control cycle.
  virtual void receive(const Message& message) { (void)message; }
  virtual void timer(TimerId id) { (void)id; }
  virtual void notice(MessageId id, Fate fate) { (void)id, (void)fate; }
  virtual void stop() {}  ///< Once, when the run ends.
};

/// A value that a controller records.
struct RecordSpec {
  std::string name{};
  std::string unit{};  ///< "s", "m", "1" for a plain number or a share, …
  std::string meaning{};
};

/// What is wrong with parameters together, each of which may be as it is.
struct ParameterMistake {
  std::string name{};     ///< Of the parameter that is said to be wrong.
  std::string what{};     ///< "1 s is before `start`, 2 s".
  bool can_work = false;  ///< It is hardly meant, but allowed: a warning.
};

/// What there is to know about a kind of controller before one is made.
struct ControllerKind {
  using MakeForMote = std::unique_ptr<Controller> (*)(Mote&, const Parameters&);
  using Judge = std::vector<ParameterMistake> (*)(const Parameters&);
  using MakeForRobot = std::unique_ptr<Controller> (*)(Robot&, const Parameters&);

  /// Digest of the HAL's headers this was compiled with. A plug-in with another one is refused: so
  /// this stays the first member, where it can be read however the rest has changed.
  std::string build_id = BARAKA_HAL_DIGEST;
  std::string name{};  ///< Of the program, e.g. "help_mote".
  Wants wants{};
  std::vector<ParameterSpec> parameters{};
  /// Judges parameters together before a run, each of them already checked. Null: all go together.
  Judge judge = nullptr;
  /// Every name it calls RealWorldObject::state() with, so that a scenario that waits for another
  /// one is refused before it runs; other names are refused then. Empty: any name, unchecked.
  std::vector<std::string> states{};
  /// Every name it calls RealWorldObject::record() with, so that a scenario that observes another
  /// one is refused before it runs, and results have its unit; other names are refused then. Empty:
  /// any name, unchecked.
  std::vector<RecordSpec> records{};
  MakeForMote make_for_mote = nullptr;    ///< Null: does not run on motes.
  MakeForRobot make_for_robot = nullptr;  ///< Null: does not run on robots.
};

template <class T>
std::unique_ptr<Controller> make_for_mote(Mote& mote, const Parameters& parameters) {
  return std::make_unique<T>(mote, parameters);
}
template <class T>
std::unique_ptr<Controller> make_for_robot(Robot& robot, const Parameters& parameters) {
  return std::make_unique<T>(robot, parameters);
}

}  // namespace hal

/// The one entry of a controller's object library: the generic main links it, a plug-in exports it.
/// Defined once per controller, by
///   BARAKA_CONTROLLER { return {.name = "wanderer", .wants = {{"infrared"}},
///                               .make_for_robot = hal::make_for_robot<Wanderer>}; }
#define BARAKA_CONTROLLER                                                      \
  static hal::ControllerKind baraka_describe_controller();                     \
  extern "C" __attribute__((visibility("default"))) const hal::ControllerKind* \
  baraka_controller() {                                                        \
    static const hal::ControllerKind kind = baraka_describe_controller();      \
    return &kind;                                                              \
  }                                                                            \
  static hal::ControllerKind baraka_describe_controller()

extern "C" const hal::ControllerKind* baraka_controller();
