#include "hal/files/description/route_names.h"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "hal/files/config/suggest.h"
#include "hal/types/pattern.h"

namespace hal::files::description {

bool is_pattern(const std::string& name) { return name.find_first_of("*?") != std::string::npos; }

void RouteNames::mistake(const std::string& key, std::string what) {
  row_.mistake(key, std::move(what));
  is_good_ = false;
}

std::vector<std::size_t> RouteNames::meant(const std::string& key, const std::string& name) {
  std::vector<std::size_t> matching;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    if (is_pattern(name) ? matches(name, agents_[i].name) : name == agents_[i].name)
      matching.push_back(i);
    names.push_back(agents_[i].name);
  }
  if (!matching.empty()) return matching;
  mistake(key, is_pattern(name)
                   ? fmt::format("'{}' matches no agent", name)
                   : fmt::format("unknown agent '{}'{}", name, config::suggestion(name, names)));
  return matching;
}

std::optional<std::size_t> RouteNames::via(const std::string& name) {
  if (is_pattern(name)) {
    mistake("via", fmt::format("'{}' must be the name of one agent", name));
    return std::nullopt;
  }
  const std::vector<std::size_t> one = meant("via", name);
  return one.empty() ? std::nullopt : std::optional(one.front());
}

std::vector<std::size_t> RouteNames::path(const std::vector<std::string>& names) {
  std::vector<std::size_t> all;
  std::set<std::size_t> seen;
  for (const std::string& name : names) {
    for (const std::size_t one : meant("path", name)) {
      if (seen.insert(one).second) {
        all.push_back(one);
      } else {
        mistake("path", fmt::format("{} is on the path twice", agents_[one].name));
      }
    }
  }
  if (all.size() == 1) mistake("path", "must have at least two agents");
  return all;
}

}  // namespace hal::files::description
