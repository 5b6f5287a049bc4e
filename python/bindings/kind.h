#pragma once

#include <pybind11/pybind11.h>

#include "hal/api/controller.h"

namespace python::bindings {

/// What a class below baraka.Controller says of itself, checked. The class, and the kind, live as
/// long as the process.
/// @param name  of the controller, for messages and processes.
/// @throws HalError, pybind11::error_already_set  naming the attribute that is wrong.
const hal::ControllerKind& kind_of(pybind11::handle of_class, const std::string& name);

/// The name of capsules that hold a const hal::ControllerKind*.
inline constexpr const char* kKindCapsule = "hal::ControllerKind";

}  // namespace python::bindings
