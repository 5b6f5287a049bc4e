#include "hal/api/controller.h"

/// A plug-in that says it was built with other headers.
BARAKA_CONTROLLER { return {.build_id = "of another day", .name = "foreign"}; }
