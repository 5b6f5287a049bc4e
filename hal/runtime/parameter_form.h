#pragma once

#include <string>

#include "hal/api/parameters.h"
#include "hal/config/key.h"
#include "hal/exchange/session.h"
#include "hal/types/result.h"

namespace hal::runtime {

/// What the value of a parameter must look like in a file.
config::Form form_of(const ParameterSpec& spec);

/// The value as a file would have it: "0.5 m/s", "true", "[1 m, 2 m]".
std::string written(const ParameterSpec& spec, const ParameterValue& value);

/// The value, in SI units. Errors: kInvalidArgument with what is wrong, without place or name.
/// @pre the unit of `spec` is one.
Result<ParameterValue> parse_parameter(const ParameterSpec& spec,
                                       const exchange::ParameterText& given);

}  // namespace hal::runtime
