#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/record/run_reader.h"

namespace results::record {

/// One result of a run that is a single number.
struct Scalar {
  /// Stable: lower case, digits, '_' and dots, as in scalar_kinds(); DDS topics by topic_part().
  std::string name;
  std::string unit;   ///< "s", "m", "J", …; "1": a share or a count.
  std::string agent;  ///< Name of the agent; "": of the run.
  double value = 0;   ///< Finite.
};

/// Possible values of a scalar.
enum class Range : std::uint8_t {
  kAny,
  kNotNegative,
  kCount,  ///< Number of events or things: 0, 1, 2, …
  kShare,  ///< 0 .. 1
};

/// A scalar that the result of every run has, or a family of such scalars.
struct ScalarKind {
  /// The name of a family contains a word in capitals, "messages.ends.VERDICT", or two.
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
  /// SQL on the tables of the result. Each row has the agent's name ("": of the run), the value
  /// (null: none) and, in a family, the words that replace the words in capitals.
  std::string query;
  /// None: kCount if the unit is "1", kAny without a unit, else kNotNegative.
  std::optional<Range> range{};
  /// For a share: name of the scalar that is the number of trials, in a family with the same words;
  /// "": there is none.
  std::string_view trials = "";
  /// For a family of counts and times: its words are not known in advance. A run without any count
  /// of a word may not know that word, although other runs of the same controllers do.
  bool is_open = false;
};

/// All kinds: what `baraka describe observables` lists, and what scalars_of() reads.
const std::vector<ScalarKind>& scalar_kinds();

/// The text before and after the first word in capitals in the name of a family: "topics." and
/// ".sent". None: it is not the name of a family.
std::optional<std::pair<std::string_view, std::string_view>> around_word(std::string_view family);

/// The kind or family to which a scalar of that name belongs; null: it comes from an observable.
const ScalarKind* scalar_kind_of(std::string_view name);

/// Name of the scalar that is the number of trials of the share of that name; "": there is none.
std::string trials_of(std::string_view name);

/// Range of the scalar of that name, or of an observable and each of its values. kAny if nothing is
/// known.
Range range_of(std::string_view name);

/// All scalars of a run, whether observables were asked for or not: those of scalar_kinds(), in
/// their order, then the sums of the run's observables. A count that was possible (a word in the
/// table countable) but did not occur is 0. A scalar that the run cannot have is left out: the
/// delay of messages when none arrived, quantiles of delays when messages were only counted,
/// collisions with a radio model without collisions.
///
/// Name and agent together are unique. Where words of controllers and scenarios become equal by
/// name_part(), the later ones in their order get the suffix "_2", "_3", …. DDS topics are told by
/// topic_part(), whatever other topics there are. If an observable is kept several times in one
/// way, the first one counts.
///
/// The result depends only on the simulated course of the run: equal fingerprints give equal
/// scalars.
/// @throws std::runtime_error  the file is damaged.
std::vector<Scalar> scalars_of(RunReader& reader);

/// A number as a function of the time of a run.
struct Series {
  std::string name, unit, agent;                  ///< As in Scalar.
  std::vector<std::pair<double, double>> points;  ///< Simulated time [s], value; sorted by time.
};

/// The observables of a run that were recorded as samples.
std::vector<Series> series_of(RunReader& reader);

/// A histogram.
struct Bins {
  struct Bin {
    double lower = 0, upper = 0;  ///< In the unit; lower <= value < upper; may be infinite.
    std::uint64_t count = 0;
  };
  std::string name, unit, agent;  ///< As in Scalar.
  std::vector<Bin> bins;          ///< Sorted by lower bound.
};

/// The observables of a run that were recorded as histograms.
std::vector<Bins> bins_of(RunReader& reader);

/// Converts a text to a part of a name: lower case, with '_' for everything that is not a letter or
/// a digit. "no route" becomes "no_route".
std::string name_part(std::string_view text);

}  // namespace results::record
