#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace baraka::run {

/// Whether a text is a DDS domain, "7", or a range of domains, "7-9".
bool is_domain_range(std::string_view text);

/// The DDS domains for parallel runs, one for each.
/// @param text  accepted by is_domain_range(); a single number is the first of `jobs` domains.
///   Empty: each run takes the first free domain.
/// @param jobs  number of parallel runs.
/// @return empty for an empty text.
/// @throws UsageError  the range has too few domains, or exceeds the highest domain.
std::vector<int> domains_for(const std::string& text, int jobs);

}  // namespace baraka::run
