#include "sim/scenario/report_section.h"

#include <array>

#include "sim/scenario/fields.h"

namespace sim::scenario {
namespace {

using report::IntervalKind;
using report::PlotKind;
using report::PlotRequest;

constexpr std::array kPlotKinds = {
    Option<PlotKind>{"automatic", PlotKind::kAutomatic},
    Option<PlotKind>{"points", PlotKind::kPoints}, Option<PlotKind>{"table", PlotKind::kTable},
    Option<PlotKind>{"histogram", PlotKind::kHistogram}, Option<PlotKind>{"time", PlotKind::kTime}};
constexpr std::array kIntervalKinds = {Option<IntervalKind>{"student", IntervalKind::kStudent},
                                       Option<IntervalKind>{"bootstrap", IntervalKind::kBootstrap}};
constexpr std::array kPublished = {Option<Published>{"nothing", Published::kNothing},
                                   Option<Published>{"labella2009", Published::kLabella2009}};

PlotRequest read_request(Mapping& in) {
  PlotRequest request;
  request.plot =
      in.text({"plot", "A quantity of the runs: `baraka describe observables` lists them.",
               "messages.delivery_ratio"});
  request.versus = in.text({"versus", "Key of the setting along the axis; its last part will do.",
                            "radio.transmit_power", "the first that is varied"},
                           "");
  request.by = in.text({"by", "Key of the setting that has a curve for each of its values.",
                        "radio.profile", "all others that are varied"},
                       "");
  request.agent = in.text(
      {"agent", "Whose, if agents have it.", "NAME0", "the run's, or the mean over the agents"},
      "");
  request.as = in.choice({"as",
                          "Mean over the runs with its interval versus a setting, the same as a "
                          "table alone, how often which values, or over simulated time.",
                          "points", "points if a setting is varied, else time or histogram"},
                         kPlotKinds, PlotKind::kAutomatic);
  request.interval =
      in.choice({"interval",
                 "Of the mean over the runs, 95 %: Student's t, or a BCa bootstrap, which needs 50 "
                 "runs.",
                 "student"},
                kIntervalKinds, IntervalKind::kStudent);
  in.finish();
  return request;
}

}  // namespace

std::vector<PlotRequest> read_report(Mapping& in) {
  std::vector<PlotRequest> requests;
  for (Mapping& one :
       in.mappings({"report", "What the report shows of the runs; changes nothing about them.",
                    "[{plot: messages.delivery_ratio, as: table}]",
                    "the quantities of the run in which the settings that are varied differ"})) {
    requests.push_back(read_request(one));
  }
  return requests;
}

void write_report(Writer& out, const std::vector<PlotRequest>& requests) {
  if (requests.empty()) return;
  out.open_list("report");
  for (const PlotRequest& request : requests) {
    out.open_item();
    out.text("plot", request.plot);
    if (!request.versus.empty()) out.text("versus", request.versus);
    if (!request.by.empty()) out.text("by", request.by);
    if (!request.agent.empty()) out.text("agent", request.agent);
    out.text("as", report::name_of(request.as));
    out.text("interval", report::name_of(request.interval));
    out.close();
  }
  out.close();
}

Published read_compare(Mapping& in) {
  return in.choice({"compare",
                    "Published figures that the report shows beside those of the runs: of Labella, "
                    "Dietrich, Dressler (2009), whose case study this then must be.",
                    "labella2009"},
                   kPublished, Published::kNothing);
}

void write_compare(Writer& out, Published published) {
  if (published == Published::kLabella2009) out.text("compare", "labella2009");
}

}  // namespace sim::scenario
