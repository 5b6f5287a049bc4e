#pragma once

/// What programs find in place of the C library's call of the same name.
#define BARAKA_EXPORTED extern "C" __attribute__((visibility("default")))
