#pragma once

#include <string>

namespace hal {
struct ControllerKind;
}

/// The controller in a Python file; null, with `mistake` set: there is none. The result is valid
/// as long as the process. One thread at a time.
extern "C" __attribute__((visibility("default"))) const hal::ControllerKind*
baraka_python_controller(const char* file, std::string& mistake);
