#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "hal/api/controller.h"
#include "hal/types/result.h"

namespace gateway::runtime {

/// Whether a scenario's `program` is a Python file: its name ends in ".py".
bool is_python(std::string_view program);

/// The interpreter of controllers in Python, as processes and in this one: BARAKA_PYTHON of the
/// environment, a path, else Debian's.
std::string python_interpreter();

/// Asks a Python file for its controller, with Python in this process: the library libbaraka_python
/// of the package python3-baraka, which is loaded once. The result is valid until the process ends.
/// Not thread safe.
/// Errors: kNotAvailable (the library is not there), kInvalidArgument (the file has no controller,
/// or Python cannot run it: file and line), kProtocol (the package was built with other headers).
hal::Result<const hal::ControllerKind*> load_python(const std::filesystem::path& file);

}  // namespace gateway::runtime
