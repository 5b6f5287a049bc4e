#pragma once

#include <string>

#include "hal/api/parameters.h"
#include "hal/files/config/key.h"
#include "hal/node/exchange/session.h"
#include "hal/types/result.h"

namespace gateway::runtime {

/// The required form of a parameter's value in a file.
hal::files::config::Form form_of(const hal::ParameterSpec& spec);

/// Writes a value as it would be in a file: "0.5 m/s", "true", "[1 m, 2 m]".
std::string written(const hal::ParameterSpec& spec, const hal::ParameterValue& value);

/// Parses a value, into SI units. Errors: kInvalidArgument with what is wrong, without position or
/// name.
/// @pre the unit of `spec` is a known unit.
hal::Result<hal::ParameterValue> parse_parameter(const hal::ParameterSpec& spec,
                                                 const hal::node::exchange::ParameterText& given);

}  // namespace gateway::runtime
