#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "python/simulator/episode.h"

namespace {

namespace py = pybind11;
using python::simulator::AgentView;
using python::simulator::Episode;
using python::simulator::Situation;

py::array_t<double> array_of(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::dict view_of(const AgentView& view) {
  py::dict readings;
  for (const auto& [name, values] : view.readings) readings[py::str(name)] = array_of(values);
  py::dict all;
  all["readings"] = readings;
  all["pose"] = py::make_tuple(view.pose.x, view.pose.y, view.pose.theta);
  all["clearance"] = view.clearance;
  return all;
}

py::dict dict_of(const Situation& situation) {
  py::list agents;
  for (const AgentView& one : situation.agents) agents.append(view_of(one));
  py::dict all;
  all["now"] = hal::to_seconds(situation.now);
  all["agents"] = agents;
  all["ended"] = situation.ended;
  all["result"] = situation.result;
  all["fingerprint"] = situation.fingerprint;
  return all;
}

/// Without the interpreter's lock, which the run's thread may be waiting for: others' controllers
/// may be in Python.
struct DeleteUnlocked {
  void operator()(Episode* episode) const {
    const py::gil_scoped_release others_may_run;
    delete episode;
  }
};
using EpisodePointer = std::unique_ptr<Episode, DeleteUnlocked>;

EpisodePointer make(const std::string& file, const std::vector<std::string>& overrides,
                    const std::vector<std::string>& agents, std::optional<double> until) {
  std::optional<hal::Time> end;
  if (until) {
    constexpr double kLatest = 9e9;  // s, of hal::from_seconds()
    if (!(*until >= 0 && *until < kLatest)) throw py::value_error("until: is no time of a run");
    end = hal::Time{hal::from_seconds(*until)};
  }
  const py::gil_scoped_release others_may_run;
  return EpisodePointer(new Episode(file, overrides, agents, end));
}

py::dict begin(Episode& self) {
  const Situation situation = [&self] {
    const py::gil_scoped_release others_may_run;
    return self.begin();
  }();
  return dict_of(situation);
}

py::dict advance(Episode& self, const std::vector<std::array<double, 3>>& drives) {
  std::vector<hal::Twist2> twists;
  twists.reserve(drives.size());
  for (const auto& [vx, vy, omega] : drives) twists.push_back({vx, vy, omega});
  const Situation situation = [&] {
    const py::gil_scoped_release others_may_run;
    return self.advance(twists);
  }();
  return dict_of(situation);
}

/// The largest speed along one direction of (vx, vy, omega) alone [m/s, rad/s]; 0: none.
double largest_along(const hal::node::exchange::DriveLimits& limits, std::size_t direction) {
  double largest = 0;
  for (const auto& row : limits.body_to_wheel) {
    if (row.at(direction) != 0) {
      const double here = limits.wheel_speed / std::abs(row.at(direction));
      largest = largest == 0 ? here : std::min(largest, here);
    }
  }
  return largest;
}

/// Whether the wheels can drive in that direction at all.
bool can_drive(const hal::node::exchange::DriveLimits& limits, std::size_t direction) {
  if (limits.wheel_to_body.empty()) return true;
  double moved = 0;
  for (std::size_t i = 0; i < limits.wheel_to_body.size(); ++i) {
    moved += limits.body_to_wheel.at(i).at(direction) * limits.wheel_to_body[i].at(direction);
  }
  constexpr double kNothing = 1e-9;
  return std::abs(moved) > kNothing;
}

py::list robots(const Episode& self) {
  py::list all;
  for (const hal::node::exchange::AgentSession& session : self.sessions()) {
    py::list channels;
    for (const hal::Channel& one : session.channels) {
      channels.append(py::make_tuple(one.name, one.kind, one.unit, one.length, one.low, one.high));
    }
    py::list largest;
    for (std::size_t i = 0; i < 3; ++i) {
      largest.append(can_drive(session.limits, i) ? largest_along(session.limits, i) : 0.0);
    }
    py::dict robot;
    robot["name"] = session.name;
    robot["control_period"] = hal::to_seconds(session.control_period);
    robot["channels"] = channels;
    robot["largest"] = largest;
    all.append(robot);
  }
  return all;
}

}  // namespace

/// The simulator in Python, for python/baraka/environment.py.
PYBIND11_MODULE(_simulator, module) {
  module.doc() = "A run whose robots are driven from Python.";
  py::class_<Episode, EpisodePointer>(module, "Episode")
      .def(py::init(&make), py::arg("file"), py::arg("overrides"), py::arg("agents"),
           py::arg("until"))
      .def("robots", robots)
      .def("begin", begin)
      .def("advance", advance, py::arg("drives"))
      .def("end", &Episode::end, py::call_guard<py::gil_scoped_release>());
}
