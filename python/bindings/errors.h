#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>

#include "hal/types/result.h"

namespace python::bindings {

/// An error of the HAL on its way to Python, where it is the exception of that name.
struct HalError : std::runtime_error {
  explicit HalError(const hal::Error& why) : std::runtime_error(why.message), code(why.code) {}
  hal::Errc code;
};

/// A value that a caller in Python got wrong: becomes baraka.InvalidArgument.
[[noreturn]] void refuse(const std::string& what);

/// The value of a result. @throws HalError
template <class T>
T value_of(hal::Result<T> result) {
  if (!result) throw HalError(std::move(result.error()));
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// Defines the exceptions: baraka.Error and one below it for each hal::Errc; baraka.CallError for
/// calls outside a callback, from another thread or after the end of the run.
void add_errors(pybind11::module_& module);

}  // namespace python::bindings
