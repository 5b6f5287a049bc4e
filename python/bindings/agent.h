#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "hal/api/robot.h"

namespace python::bindings {

/// The Mote or Robot of a controller as Python sees it. Python may keep it longer than the
/// controller lives; its calls are then refused.
class AgentHandle {
 public:
  explicit AgentHandle(hal::RealWorldObject& object) : object_(&object) {}

  /// Read arguments before: what reads them may be in Python, and meanwhile the controller may go.
  /// @throws std::logic_error  the controller is gone.
  hal::RealWorldObject& object() const;

  /// The controller is gone.
  void end() { object_ = nullptr; }

 private:
  hal::RealWorldObject* object_;
};

/// baraka.Mote.
class MoteHandle : public AgentHandle {
 public:
  explicit MoteHandle(hal::Mote& mote) : AgentHandle(mote) {}
};

/// baraka.Robot.
class RobotHandle : public AgentHandle {
 public:
  explicit RobotHandle(hal::Robot& robot) : AgentHandle(robot) {}
  hal::Robot& robot() const { return static_cast<hal::Robot&>(object()); }
};

using AgentClass = pybind11::class_<AgentHandle, std::shared_ptr<AgentHandle>>;

/// Defines baraka.RealWorldObject, Mote and Robot.
void add_agents(pybind11::module_& module);
/// The calls of Robot alone.
void add_robot(pybind11::module_& module);
/// The calls about messages and routes, and baraka.Network.
void add_network(pybind11::module_& module, AgentClass& agent);
/// The calls about readings and channels.
void add_readings(AgentClass& agent);
/// Defines baraka.RandomStream and the choice of a route, and random().
void add_random(pybind11::module_& module, AgentClass& agent);
/// Defines baraka.math.
void add_math(pybind11::module_& module);

}  // namespace python::bindings
