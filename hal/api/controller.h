#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal/api/parameters.h"
#include "hal/api/real_world_object.h"
#include "hal/api/robot.h"
#include "hal/types/wants.h"

namespace hal {

/// The behaviour of one agent. The HAL calls one callback at a time, never re-entrantly. The
/// constructor gets the Mote& or Robot&, which is valid for the life of the controller. Do not use
/// mutable globals: in process all agents would share them. A callback that throws ends the run;
/// the message is reported.
class Controller {
 public:
  virtual ~Controller() = default;
  /// Called once, before all other calls: in the simulator at time 0 or, with `control_phase:
  /// uniform`, at the agent's own phase, which is shorter than a control period. Timers set here
  /// then differ between agents.
  virtual void start() {}
  virtual void step() {}  ///< Called once per control cycle.
  /// A message has arrived: for this agent, for kEveryone, or for kNeighbours of its sender.
  virtual void receive(const Message& message) { (void)message; }
  /// A timer of RealWorldObject::set_timer() has expired.
  virtual void timer(TimerId id) { (void)id; }
  /// The result of a message that this agent sent.
  /// @param id  as RealWorldObject::send() returned it.   @param fate  the result.
  virtual void notice(MessageId id, Fate fate) { (void)id, (void)fate; }
  virtual void stop() {}  ///< Called once, when the run ends.
};

/// A value that a controller records.
struct RecordSpec {
  std::string name{};     ///< As in RealWorldObject::record().
  std::string unit{};     ///< "s", "m", "1" for a plain number or a share, …
  std::string meaning{};  ///< One-line description.
};

/// A contradiction between parameters that are valid one by one.
struct ParameterMistake {
  std::string name{};     ///< The parameter to report as wrong.
  std::string what{};     ///< "1 s is before `start`, 2 s".
  bool can_work = false;  ///< Permitted but probably unintended: reported as a warning.
};

/// Description of a kind of controller.
struct ControllerKind {
  /// Makes the controller of one mote, e.g. hal::make_for_mote<HelpMote>.
  using MakeForMote = std::function<std::unique_ptr<Controller>(Mote&, const Parameters&)>;
  /// Returns contradictions between parameters; empty if there are none.
  using Judge = std::function<std::vector<ParameterMistake>(const Parameters&)>;
  /// Makes the controller of one robot, e.g. hal::make_for_robot<Wanderer>.
  using MakeForRobot = std::function<std::unique_ptr<Controller>(Robot&, const Parameters&)>;

  /// Digest of the HAL's headers at compile time. A plug-in with another digest is refused. This
  /// stays the first member, so that it can be read whatever else has changed.
  std::string build_id = BARAKA_HAL_DIGEST;
  std::string name{};                       ///< Name of the program, e.g. "help_mote".
  Wants wants{};                            ///< Channels, topics and names that it subscribes to.
  std::vector<ParameterSpec> parameters{};  ///< All parameters that a scenario may set.
  /// Checks the combination of parameters before a run, each already checked by itself. Null: all
  /// combinations are valid.
  Judge judge = nullptr;
  /// All names that it passes to RealWorldObject::state(). Then a scenario that waits for another
  /// state is refused before it runs, and state() refuses other names. Empty: any name, unchecked.
  std::vector<std::string> states{};
  /// All names that it passes to RealWorldObject::record(). Then a scenario that observes another
  /// value is refused before it runs, results have the unit, and record() refuses other names.
  /// Empty: any name, unchecked.
  std::vector<RecordSpec> records{};
  MakeForMote make_for_mote = nullptr;    ///< Null: does not run on motes.
  MakeForRobot make_for_robot = nullptr;  ///< Null: does not run on robots.
};

/// For ControllerKind::make_for_mote: T has a constructor T(Mote&, const Parameters&).
template <class T>
std::unique_ptr<Controller> make_for_mote(Mote& mote, const Parameters& parameters) {
  return std::make_unique<T>(mote, parameters);
}
/// For ControllerKind::make_for_robot: T has a constructor T(Robot&, const Parameters&).
template <class T>
std::unique_ptr<Controller> make_for_robot(Robot& robot, const Parameters& parameters) {
  return std::make_unique<T>(robot, parameters);
}

}  // namespace hal

/// The entry point of a controller's object library: the generic main links it, a plug-in exports
/// it. Define it once per controller, by
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

/// The function that BARAKA_CONTROLLER defines. Its result is valid for the life of the program or
/// plug-in.
extern "C" const hal::ControllerKind* baraka_controller();
