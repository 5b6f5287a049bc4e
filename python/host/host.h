#pragma once

#include <string>

namespace hal {
struct ControllerKind;
}

/// The controller in a Python file; null, with `mistake` set: there is none. The result is valid
/// as long as the process. One thread at a time.
/// @param interpreter  the program whose modules are found, as it would find them itself: those of
/// its virtual environment, too. Only that of the first call counts.
extern "C" __attribute__((visibility("default"))) const hal::ControllerKind*
baraka_python_controller(const char* file, const char* interpreter, std::string& mistake);
