#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gateway::runtime {

/// Counts the calls of one controller that violate the rules of the HAL, so that the log reports
/// each kind of mistake without being flooded: a controller repeats its mistakes in every control
/// cycle. Mistakes are of one kind if they differ in numbers and quoted names only.
class Mistakes {
 public:
  /// @return what is to be logged: the first of a kind as it is, the 10th, 100th, … with their
  ///   number, nothing of the others.
  std::optional<std::string> add(const std::string& text);

  /// One line per kind of which some were not logged, with their number, in order of appearance.
  std::vector<std::string> rest() const;

 private:
  struct Kind {
    std::string first;  ///< As it was said.
    std::uint64_t count = 0;
    std::uint64_t told = 0;  ///< The count that was logged last.
  };
  Kind& kind_of(const std::string& text);

  std::map<std::string, std::size_t> numbers_;
  std::vector<Kind> kinds_;
};

}  // namespace gateway::runtime
