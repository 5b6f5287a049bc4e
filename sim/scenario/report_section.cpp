#include "sim/scenario/report_section.h"

#include <array>

namespace sim::scenario {
namespace {

constexpr std::array kPublished = {Option<Published>{"nothing", Published::kNothing},
                                   Option<Published>{"labella2009", Published::kLabella2009}};

void request_keys(Fields& io, PlotRequest& c) {
  io.needed_text({"plot", "Quantity to show; `baraka describe observables` lists them.",
                  "messages.delivery_ratio"},
                 c.plot);
  io.given_text(
      {"versus", "Key of the setting on the horizontal axis; the last part of its path is enough.",
       "radio.transmit_power", "the first that is varied"},
      c.versus);
  io.given_text({"by", "Key of the setting that has one curve for each of its values.",
                 "radio.profile", "all others that are varied"},
                c.by);
  io.given_text({"agent", "Agent whose value is shown, if the quantity belongs to agents.", "NAME0",
                 "the run's, or the mean over the agents"},
                c.agent);
  io.choice(
      {"as",
       "points: mean over the runs with its confidence interval versus a setting; table: the same, "
       "without a figure; histogram: distribution of the values; time: course over simulated time.",
       "points", "points if a setting is varied, else time or histogram"},
      kPlotKinds, c.as);
  io.choice({"interval",
             "95 % confidence interval of the mean over the runs: Student's t, or a BCa bootstrap, "
             "which needs 50 runs.",
             "student"},
            kIntervalKinds, c.interval);
}

}  // namespace

void report_keys(Fields& io, std::vector<PlotRequest>& requests) {
  io.list_if_any<PlotRequest>(
      {"report", "What the report shows of the runs; has no effect on them.",
       "[{plot: messages.delivery_ratio, as: table}]",
       "the quantities of the run that differ between the varied settings"},
      requests, [](Fields& one, PlotRequest& request) { request_keys(one, request); });
}

void compare_key(Fields& io, Published& published) {
  io.written_if(published != Published::kNothing, [&](Fields& written) {
    written.choice(
        {"compare",
         "Published figures that the report shows beside those of the runs. labella2009: those of "
         "Labella, Dietrich, Dressler (2009), for their case study only.",
         "labella2009"},
        kPublished, published);
  });
}

}  // namespace sim::scenario
