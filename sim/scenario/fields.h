#pragma once

#include "hal/description/fields.h"

namespace sim::scenario {

using hal::config::Key;
using hal::config::kUnlimited;
using hal::config::Mapping;
using hal::config::Option;
using hal::config::Range;
using hal::config::Writer;
using hal::description::FieldReader;
using hal::description::FieldWriter;
using hal::description::kAngle;

constexpr Range kCoordinate{-1e6, 1e6};  ///< m, world frame.

}  // namespace sim::scenario
