#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/record/run_reader.h"

namespace results::record {

/// One number of a run.
struct Scalar {
  std::string name;   ///< Stable: lower case, digits, '_' and dots, as in scalar_kinds().
  std::string unit;   ///< "s", "m", "J", …; "1": a share or a count.
  std::string agent;  ///< Name; "": of the run.
  double value = 0;   ///< Finite.
};

/// Which values a number can have.
enum class Range : std::uint8_t {
  kAny,
  kNotNegative,
  kCount,  ///< Of things that happen: 0, 1, 2, …
  kShare,  ///< 0 .. 1
};

/// A number that the result of every run has, or a family of them.
struct ScalarKind {
  /// Ends in a word in capitals if it is a family: "messages.ends.VERDICT".
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
  /// Of the result's tables: rows of agent's name ("": of the run), value (null: none) and, of a
  /// family, what stands for the word in capitals.
  std::string query;
  /// None: of unit "1" kCount, without a unit kAny, else kNotNegative.
  std::optional<Range> range{};
  /// Of a share: name of the number of trials of which it is the share; "": there is none.
  std::string_view trials = "";
  /// Of a family of counts and times: its words are not known before they come up, so that a run
  /// that has none of a word may not know of it, while runs of the same controllers do.
  bool is_open = false;
};

/// All of them: what `baraka describe observables` prints of them, and what scalars_of() reads.
const std::vector<ScalarKind>& scalar_kinds();

/// What stands about the word in capitals in the name of a family: "topics." and ".sent". None: the
/// name is of no family.
std::optional<std::pair<std::string_view, std::string_view>> around_word(std::string_view family);

/// The kind or the family that the number of that name is of; null: it is of an observable.
const ScalarKind* scalar_kind_of(std::string_view name);

/// Of a number of that name, or of an observable, also value by value. kAny: nothing is known of
/// it.
Range range_of(std::string_view name);

/// Every run as numbers, whether observables were asked for or not: those of scalar_kinds(), in
/// their order, and the sums of the observables of the run. What a run could have counted and did
/// not is 0: the words of the table countable. What it does not have (the delay of messages when
/// none arrived, quantiles of delays when messages were only counted, collisions with a radio
/// without any) is not there.
/// No two have the same name and agent: where words of controllers and scenarios are equal as
/// name_part(), the later ones by their order end in "_2", "_3", …; of an observable that is kept
/// several times in one way, the first counts.
/// A function of the run's simulated course: the same for equal fingerprints.
/// @throws std::runtime_error  the file is damaged.
std::vector<Scalar> scalars_of(RunReader& reader);

/// A number over the time of a run.
struct Series {
  std::string name, unit, agent;                  ///< As of a Scalar.
  std::vector<std::pair<double, double>> points;  ///< Simulated time [s], value; by time.
};

/// The observables of a run that were kept as samples.
std::vector<Series> series_of(RunReader& reader);

/// How often a number was within bounds.
struct Bins {
  struct Bin {
    double lower = 0,
           upper = 0;  ///< In the unit; lower <= value < upper. The outermost may be infinite.
    std::uint64_t count = 0;
  };
  std::string name, unit, agent;  ///< As of a Scalar.
  std::vector<Bin> bins;          ///< By lower bound.
};

/// The observables of a run that were kept as histograms.
std::vector<Bins> bins_of(RunReader& reader);

/// A text as a part of a name: in lower case, with '_' for all that is not a letter or a digit:
/// "no route" is "no_route".
std::string name_part(std::string_view text);

}  // namespace results::record
