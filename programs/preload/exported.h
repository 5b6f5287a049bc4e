#pragma once

/// Declares a function that replaces the C library's function of the same name for programs.
#define BARAKA_EXPORTED extern "C" __attribute__((visibility("default")))
