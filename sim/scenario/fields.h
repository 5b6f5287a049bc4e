#pragma once

#include "hal/files/description/field_io.h"

namespace sim::scenario {

using hal::files::config::Form;
using hal::files::config::Key;
using hal::files::config::kUnlimited;
using hal::files::config::Mapping;
using hal::files::config::Option;
using hal::files::config::Range;
using hal::files::config::Writer;
using hal::files::description::alternative;
using hal::files::description::as;
using hal::files::description::FieldNames;
using hal::files::description::FieldReader;
using hal::files::description::Fields;
using hal::files::description::FieldWriter;
using hal::files::description::kAngle;
using hal::files::description::kinds_of;

constexpr Range kCoordinate{-1e6, 1e6};  ///< m, world frame.

}  // namespace sim::scenario
