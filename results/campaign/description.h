#pragma once

#include <string>

namespace results::campaign {

/// Describes `campaign.sqlite` in Markdown: every table, column and key with its unit and meaning.
/// docs/campaign_tables.md is this text.
std::string describe_campaign();

}  // namespace results::campaign
