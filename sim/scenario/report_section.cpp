#include "sim/scenario/report_section.h"

#include <array>

namespace sim::scenario {
namespace {

constexpr std::array kPublished = {Option<Published>{"nothing", Published::kNothing},
                                   Option<Published>{"labella2009", Published::kLabella2009}};

void request_keys(Fields& io, PlotRequest& c) {
  io.needed_text({"plot", "A quantity of the runs: `baraka describe observables` lists them.",
                  "messages.delivery_ratio"},
                 c.plot);
  io.given_text({"versus", "Key of the setting along the axis; its last part will do.",
                 "radio.transmit_power", "the first that is varied"},
                c.versus);
  io.given_text({"by", "Key of the setting that has a curve for each of its values.",
                 "radio.profile", "all others that are varied"},
                c.by);
  io.given_text(
      {"agent", "Whose, if agents have it.", "NAME0", "the run's, or the mean over the agents"},
      c.agent);
  io.choice({"as",
             "Mean over the runs with its interval versus a setting, the same as a table alone, "
             "how often which values, or over simulated time.",
             "points", "points if a setting is varied, else time or histogram"},
            kPlotKinds, c.as);
  io.choice({"interval",
             "Of the mean over the runs, 95 %: Student's t, or a BCa bootstrap, which needs 50 "
             "runs.",
             "student"},
            kIntervalKinds, c.interval);
}

}  // namespace

void report_keys(Fields& io, std::vector<PlotRequest>& requests) {
  io.list_if_any<PlotRequest>(
      {"report", "What the report shows of the runs; changes nothing about them.",
       "[{plot: messages.delivery_ratio, as: table}]",
       "the quantities of the run in which the settings that are varied differ"},
      requests, [](Fields& one, PlotRequest& request) { request_keys(one, request); });
}

void compare_key(Fields& io, Published& published) {
  io.written_if(published != Published::kNothing, [&](Fields& written) {
    written.choice({"compare",
                    "Published figures that the report shows beside those of the runs: of Labella, "
                    "Dietrich, Dressler (2009), whose case study this then must be.",
                    "labella2009"},
                   kPublished, published);
  });
}

}  // namespace sim::scenario
