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
  /// @return what is to be logged: the first mistake of a kind unchanged, the 10th, 100th, … with
  /// their number, nothing for the others.
  std::optional<std::string> add(const std::string& text);

  /// One line with the number for each kind of which some mistakes were not logged, in order of
  /// first occurrence.
  std::vector<std::string> rest() const;

 private:
  struct Kind {
    std::string first;  ///< Text of the first.
    std::uint64_t count = 0;
    std::uint64_t told = 0;  ///< Count at the last log line.
  };
  Kind& kind_of(const std::string& text);

  std::map<std::string, std::size_t> numbers_;
  std::vector<Kind> kinds_;
};

}  // namespace gateway::runtime
