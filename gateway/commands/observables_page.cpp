#include "gateway/commands/observables_page.h"

#include <fmt/format.h>

#include "sim/record/observable.h"
#include "sim/record/scalars.h"

namespace gateway {
namespace {

using sim::record::ObservableKind;
using sim::record::ScalarKind;

constexpr const char* kAboutObservables = R"(# Observables

<!-- Written by `baraka describe observables --markdown`; the words stand where the values are made. -->

What a run says in numbers: values that a scenario asks to be followed through the run, and numbers
that every run has. Reports, exports and campaigns know both by the names below.

## Values to follow

```yaml
record:
  observables:
    - {name: agents.r*.speed, every: 1 s}                               # samples: value by value
    - {name: radio.*.queue, on: change, as: quantiles}
    - {name: messages.*.delay, on: change, as: histogram, range: [0, 2]}
    - {name: controllers.r*.nearest, every: 500 ms, as: counter}        # count, mean, sd, min, max, last
```

A name is DOMAIN.AGENT.VALUE; in agent and value `*` stands for any letters and `?` for one. A name
that no agent has is a mistake, which `baraka check` tells. `every` looks at a value at time 0 and then
after each period, when all that happens at that instant has happened; a period need not be a multiple
of the physics step or of the control period, and the value is the one of that instant. `on: change`
looks when something happens: each time at what only happens (`delay`, `rssi`, `discovery_time`, what a
controller records), at all else at the control instants of the agent, if it is not as it was before.
What there is none of then is left out: the range of a sensor that sees nothing, the delay before the
first message arrived.

To look changes nothing: a run that is observed has the fingerprint of one that is not, in process and
over DDS, in lock-step, in real time and repeated.

`baraka export DIR observable_samples` and the tables `observables`, `observable_sums`,
`observable_bins` and `observable_quantiles` have them (docs/results.md). Sums, bins and quantiles are
written when the run ends; samples as it goes. Of an hour with 37 agents, a value each second is 133,200
samples; `most` bounds them, agent by agent. Histograms and quantiles need as much memory for an hour
as for a minute: quantiles are exact up to 10,000 values and then wrong by at most 0.001 of the rank
(Greenwald and Khanna, 2001), which the table says.

)";

constexpr const char* kAboutNumbers = R"(
## Numbers that every run has

A word in capitals stands for a verdict, a topic, a state and so on, in lower case and with `_` for what
is not a letter or a digit: `messages.ends.no_route`. Of agents, each has its own. Of an observable
DOMAIN.AGENT.VALUE, each agent has DOMAIN.VALUE.count, .mean, .mean_over_time (each value counted by the
time until the next), .sd, .min, .max, .last and, `as: quantiles`, .p01, .p05, .p25, .p50, .p75, .p95,
.p99.

A count of what a run could have had and had not is 0, and counts in means; the table `countable` of a
result lists what it could: verdicts and classes of its radio's profile, events of its routing
protocols, states and names that its controllers declare. What a run could not have, or did not
record, it has no number of: collisions with an ideal radio, messages with `record: {messages: none}`.
Topics, and states of controllers that declare none, are known when they come up: where runs are read
together, one without them has 0 of those that another run of the same controllers had.

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
  for (const ObservableKind& kind : sim::record::observable_kinds()) {
    text += name_line(kind.name, kind.unit, kind.meaning);
  }
  text += "\nNumbers that every run has:\n";
  for (const ScalarKind& kind : sim::record::scalar_kinds()) {
    text += name_line(kind.name, kind.unit, kind.meaning);
  }
  return text +
         "\nOf each observable also DOMAIN.VALUE.count, .mean, .mean_over_time, .sd, .min, .max, "
         ".last and,\nas: quantiles, .p01 to .p99.\n";
}

std::string observables_page() {
  std::string page = kAboutObservables;
  page += kNamesHead;
  for (const ObservableKind& kind : sim::record::observable_kinds()) {
    page += name_row(kind.name, kind.unit, kind.meaning);
  }
  page += kAboutNumbers;
  page += kNamesHead;
  for (const ScalarKind& kind : sim::record::scalar_kinds()) {
    page += name_row(kind.name, kind.unit, kind.meaning);
  }
  return page;
}

}  // namespace gateway
