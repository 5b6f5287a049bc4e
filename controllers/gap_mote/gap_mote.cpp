#include "controllers/gap_mote/gap_mote.h"

namespace controllers {

GapMote::GapMote(hal::Mote& mote, const hal::Parameters& parameters)
    : mote_(mote), parameters_(parameters) {}

void GapMote::start() {
  const std::string& sink = parameters_.text("sink");
  is_sink_ = mote_.name() == sink;
  const auto address = mote_.address_of(sink);
  if (!address) mote_.log(hal::log::Level::kError, "no agent has the name of its sink, " + sink);
  sink_ = address.value_or(hal::AgentId{});
  heard_at_ = mote_.now();
  // A random first report, so that the motes do not report simultaneously.
  const double first = mote_.random().uniform();
  report_at_ = mote_.now() + hal::from_seconds(first * parameters_["report_every"]);
  mote_.state(is_sink_ ? "SINK" : "CONNECTED");
}

void GapMote::step() {
  if (is_sink_) return be_sink();
  if (sink_ == hal::AgentId{}) return;
  report();
  watch_sink();
}

void GapMote::be_sink() {
  if (mote_.now() < report_at_) return;
  report_at_ = mote_.now() + hal::from_seconds(parameters_["sign_every"]);
  say({.word = GapWord::kSink});
}

void GapMote::report() {
  if (mote_.now() < report_at_) return;
  report_at_ = report_at_ + hal::from_seconds(parameters_["report_every"]);
  const std::vector<std::uint8_t> bytes(static_cast<std::size_t>(parameters_["size"]), 0);
  (void)mote_.send(sink_, kReportTopic, bytes);
}

void GapMote::watch_sink() {
  const hal::Time now = mote_.now();
  if (now - heard_at_ < hal::from_seconds(parameters_["patience"])) return;
  if (!is_cut_off_) {
    is_cut_off_ = true;
    call_at_ = now;
    mote_.state("CUT_OFF");
  }
  if (now < call_at_) return;
  call_at_ = now + hal::from_seconds(parameters_["call_every"]);
  constexpr double kMinute = 60;  // s
  say({.word = GapWord::kCutOff, .value = kMinute / parameters_["report_every"]});
}

void GapMote::receive(const hal::Message& message) {
  const auto heard = message.topic == kGapTopic ? decode_gap(message.payload) : std::nullopt;
  if (!heard || heard->word != GapWord::kSink || message.source != sink_) return;
  heard_at_ = mote_.now();
  if (!is_cut_off_) return;
  is_cut_off_ = false;
  mote_.state("CONNECTED");
}

void GapMote::say(const GapMessage& message) {
  (void)mote_.send(hal::kEveryone, kGapTopic, encode(message));
}

}  // namespace controllers

BARAKA_CONTROLLER {
  constexpr double kHour = 3600;  // s
  return {.name = "gap_mote",
          .wants = {.names = true},
          .parameters = {{.name = "sink",
                          .default_value = "m0",
                          .meaning = "Name of the mote that the others report to."},
                         {"report_every", "s", 2, 0.1, kHour, "Time between two reports."},
                         {"size", "1", 32, 0, 1000, "Bytes of a report."},
                         {"sign_every", "s", 5, 0.5, kHour, "Time between two signs of the sink."},
                         {"patience", "s", 16, 1, kHour, "Without a sign for so long: cut off."},
                         {"call_every", "s", 5, 0.5, kHour,
                          "Time between two calls of one that is cut off."}},
          .states = {"SINK", "CONNECTED", "CUT_OFF"},
          .make_for_mote = hal::make_for_mote<controllers::GapMote>};
}
