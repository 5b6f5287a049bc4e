#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace baraka::run {

/// Whether it is a DDS domain, "7", or a range of them, "7-9".
bool is_domain_range(std::string_view text);

/// The DDS domains that runs side by side have to themselves.
/// @param text  as is_domain_range() lets it pass; empty: each run takes the first free one.
/// @param jobs  how many there are at a time. A single number is the first of as many.
/// @return empty for an empty text.
/// @throws UsageError  too few of them, or none so high.
std::vector<int> domains_for(const std::string& text, int jobs);

}  // namespace baraka::run
