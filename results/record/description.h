#pragma once

#include <string>

namespace results::record {

/// Describes what the folder of a result contains, as Markdown: every table, column and key with
/// its unit and meaning. docs/results.md is this text.
std::string describe_results();

}  // namespace results::record
