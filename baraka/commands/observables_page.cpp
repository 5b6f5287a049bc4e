#include "baraka/commands/observables_page.h"

#include <fmt/format.h>

#include "results/record/scalars.h"
#include "sim/scenario/observable.h"

namespace baraka::commands {
namespace {

using results::record::ScalarKind;
using sim::scenario::ObservableKind;

constexpr const char* kAboutObservables = R"(# Observables

<!-- Written by `baraka describe observables --markdown`; the texts are where the values are made. -->

The numbers of a run: values that a scenario asks to record over time, and numbers that every run
has. Reports, exports and campaigns use the names below for both.

## Values to follow

```yaml
record:
  observables:
    - {name: agents.r*.speed, every: 1 s}                               # samples: value by value
    - {name: radio.*.queue, on: change, as: quantiles}
    - {name: messages.*.delay, on: change, as: histogram, range: [0, 2]}
    - {name: controllers.r*.nearest, every: 500 ms, as: counter}        # count, mean, sd, min, max, last
    - {name: dds.base.rt/*/scan.age, every: 100 ms, as: quantiles}
```

A name is DOMAIN.AGENT.VALUE; in agent and value `*` stands for any number of characters and `?` for
one. A name that no agent has is a mistake, which `baraka check` reports. `every` samples a value at
time 0 and then after each period, after all other events of that instant; a period need not be a
multiple of the physics step or of the control period, and the value is that of the instant.
`on: change` records each occurrence of values that occur as events (`delay`, `rssi`, `discovery_time`,
values that a controller records), and all others at the control instants of the agent if they have
changed. A value that does not exist is left out: the range of a sensor that detects nothing, the delay
before the first message arrived.

Names of DDS values are dds.AGENT.TOPIC.VALUE: the topic as SEDP announces it, `rt/r0/scan` for ROS 2's
`/r0/scan`; it may contain dots. A topic becomes known at an agent when one of the agent's endpoints is
announced, or when the agent first transmits something of it; until then it has no values. A name of this
domain is a mistake if no agent of that name has a `network` (or, for `airtime` and `air_share`, is an
access point), or if it ends in none of the values below. `on: change` records each latency, and counts
and shares of samples when a sample is sent or arrives; `age` when a sample arrives; `airtime` and
`air_share` at control instants. They need no key of `record`, and also exist with `samples: none`.

Observing changes nothing: an observed run has the same fingerprint as one that is not observed, in
process and over DDS, in lock-step, in real time and repeated.

`baraka export DIR observable_samples` and the tables `observables`, `observable_sums`,
`observable_bins` and `observable_quantiles` contain them (docs/results.md). Sums, bins and quantiles
are written at the end of the run, samples during the run. One value each second of 37 agents is
133,200 samples in an hour; `most` limits them for each agent. Histograms and quantiles need the same
memory for an hour as for a minute: quantiles are exact up to 10,000 values, and beyond have an error
of at most 0.001 of the rank (Greenwald and Khanna, 2001), which the table states.

)";

constexpr const char* kAboutNumbers = R"(
## Numbers that every run has

A word in capitals stands for a verdict, a topic, a state and so on, in lower case and with `_` for
characters other than letters and digits: `messages.ends.no_route`. DDS topics are written as they are,
`dds.rt/r0/scan.delivered_share`, except that each octet other than letters, digits, `_`, `-` and `/`
becomes `%` and two hexadecimal digits (`a.b` is `a%2Eb`), so that different topics have different names.
Numbers of agents exist for each agent. For an observable DOMAIN.AGENT.VALUE, each agent has DOMAIN.VALUE.count, .mean, .mean_over_time
(each value weighted by the time until the next), .sd, .min, .max, .last and, `as: quantiles`, .p01,
.p05, .p25, .p50, .p75, .p95, .p99.

A count of what was possible in a run and did not occur is 0, and part of means. The table `countable`
of a result lists what was possible: verdicts and classes of its radio's profile, events of its routing
protocols, states and names that its controllers declare. There is no number of what was impossible or
not recorded: collisions with an ideal radio, messages with `record: {messages: none}`.
Topics, and states of controllers that declare none, become known when they occur: where runs are read
together, a run without them has 0 of those that another run of the same agents had. So a run in which
discovery failed has 0 samples of a topic, and no delivered share.

)";

std::string name_row(std::string_view name, std::string_view unit, std::string_view meaning) {
  return fmt::format("| `{}` | {} | {} |\n", name, unit.empty() ? "-" : unit, meaning);
}

std::string name_line(std::string_view name, std::string_view unit, std::string_view meaning) {
  return fmt::format("  {:<34} {:<7} {}\n", name, unit, meaning);
}

constexpr const char* kNamesHead = "| name | unit | meaning |\n| --- | --- | --- |\n";

}  // namespace

std::string observables_text() {
  std::string text =
      "Values to follow through a run, with record: {observables: [{name: agents.r*.speed, every: "
      "1 s}]}:\n";
  for (const ObservableKind& kind : sim::scenario::observable_kinds()) {
    text += name_line(kind.name, kind.unit, kind.meaning);
  }
  text += "\nNumbers that every run has:\n";
  for (const ScalarKind& kind : results::record::scalar_kinds()) {
    text += name_line(kind.name, kind.unit, kind.meaning);
  }
  return text +
         "\nOf each observable also DOMAIN.VALUE.count, .mean, .mean_over_time, .sd, .min, .max, "
         ".last and,\nas: quantiles, .p01 to .p99.\n";
}

std::string observables_page() {
  std::string page = kAboutObservables;
  page += kNamesHead;
  for (const ObservableKind& kind : sim::scenario::observable_kinds()) {
    page += name_row(kind.name, kind.unit, kind.meaning);
  }
  page += kAboutNumbers;
  page += kNamesHead;
  for (const ScalarKind& kind : results::record::scalar_kinds()) {
    page += name_row(kind.name, kind.unit, kind.meaning);
  }
  return page;
}

}  // namespace baraka::commands
