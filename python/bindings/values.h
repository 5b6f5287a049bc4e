#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "hal/types/path_metric.h"
#include "hal/types/route.h"
#include "hal/types/time.h"

namespace python::bindings {

/// Values given by Python, checked. `what` names the argument in the message of the exception,
/// which is baraka.InvalidArgument for a wrong value and TypeError for a wrong type.

double number_from(pybind11::handle value, std::string_view what);
std::vector<double> numbers_from(pybind11::handle value, std::string_view what);
std::string text_from(pybind11::handle value, std::string_view what);
std::vector<std::string> texts_from(pybind11::handle value, std::string_view what);
bool flag_from(pybind11::handle value, std::string_view what);
/// A whole number. @pre low <= high
std::int64_t count_from(pybind11::handle value, std::string_view what, std::int64_t low,
                        std::int64_t high);
/// An address, also baraka.EVERYONE and baraka.NEIGHBOURS.
hal::AgentId address_from(pybind11::handle value, std::string_view what);
/// Seconds since the start of the run, to the nearest nanosecond.
hal::Time time_from(pybind11::handle value, std::string_view what);
/// bytes, bytearray or memoryview.
hal::Bytes bytes_from(pybind11::handle value, std::string_view what);
/// A baraka.Route.
hal::Route route_from(pybind11::handle value);

/// Of hal/types, as the named tuples of python/baraka/values.py.
pybind11::object tuple_of(const hal::Message& message);
pybind11::object tuple_of(const hal::Route& route);
pybind11::object tuple_of(const hal::Neighbour& neighbour);

/// A class of python/baraka/values.py, found at its first use. It is a static variable that C++
/// initialises at compile time: a thread that did so at run time, and let go of the interpreter's
/// lock while it imports, would keep others waiting that hold this lock.
/// Usage: static constinit ValueClass vec2_class("Vec2"); return vec2_class(v.x, v.y);
class ValueClass {
 public:
  constexpr explicit ValueClass(const char* name) : name_(name) {}
  /// @pre the lock is held
  pybind11::handle get();
  template <class... Values>
  pybind11::object operator()(Values&&... values) {
    return get()(std::forward<Values>(values)...);
  }

 private:
  const char* name_;
  PyObject* class_ = nullptr;  ///< Never given back: Python may end before this library does.
};

}  // namespace python::bindings
