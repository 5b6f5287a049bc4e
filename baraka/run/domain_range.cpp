#include "baraka/run/domain_range.h"

#include <fmt/format.h>

#include <charconv>
#include <numeric>
#include <optional>
#include <string_view>

#include "gateway/process/domains.h"
#include "gateway/process/exit_status.h"

namespace baraka::run {
namespace {

struct DomainRange {
  int first = 0, last = 0;
  bool is_single = true;
};

std::optional<int> parse_domain(std::string_view text) {
  int domain = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
  const bool is_whole = error == std::errc{} && end == text.data() + text.size();
  if (!is_whole || domain < 0 || domain > gateway::process::kLastDomain) return std::nullopt;
  return domain;
}

std::optional<DomainRange> parse_range(std::string_view text) {
  const std::size_t dash = text.find('-');
  const auto first = parse_domain(text.substr(0, dash));
  if (!first) return std::nullopt;
  if (dash == std::string_view::npos) return DomainRange{*first, *first, true};
  const auto last = parse_domain(text.substr(dash + 1));
  if (!last || *last < *first) return std::nullopt;
  return DomainRange{*first, *last, false};
}

}  // namespace

bool is_domain_range(std::string_view text) { return parse_range(text).has_value(); }

std::vector<int> domains_for(const std::string& text, int jobs) {
  const auto range = parse_range(text);
  if (!range) return {};
  const int last = range->is_single ? range->first + jobs - 1 : range->last;
  if (last > gateway::process::kLastDomain) {
    throw gateway::process::UsageError(
        fmt::format("--domain: --jobs {} needs the domains {} to {}; the last is {}", jobs,
                    range->first, last, gateway::process::kLastDomain));
  }
  std::vector<int> all(static_cast<std::size_t>(last - range->first) + 1);
  std::iota(all.begin(), all.end(), range->first);
  if (static_cast<int>(all.size()) < jobs) {
    throw gateway::process::UsageError(
        fmt::format("--domain: {} has {} domain{}, --jobs {} needs one each", text, all.size(),
                    all.size() == 1 ? "" : "s", jobs));
  }
  return all;
}

}  // namespace baraka::run
