#include "sim/record/course_log.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "sim/record/hexadecimal.h"
#include "sim/record/run_reader.h"

namespace sim::record {

namespace {

/// In ns. A run ends before this, about 32 years.
constexpr std::int64_t kLatest = 1'000'000'000'000'000'000;

hal::Time time_in(const std::string& text, const std::filesystem::path& folder) {
  std::int64_t ns = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, ns);
  if (error == std::errc{} && rest == end && ns >= 0 && ns <= kLatest) return hal::time_from_ns(ns);
  throw std::runtime_error(fmt::format("{}: its end at '{}' ns is no time of a run from 0 to {} ns",
                                       folder.string(), text, kLatest));
}

/// Turns and arrivals are in order of time and end with the run: the queue of events relies on it.
hal::Time checked(std::int64_t ns, hal::Time after, const std::string& what, RunReader& run,
                  hal::Time ended_at) {
  const hal::Time at{hal::Duration{ns}};
  if (at >= after && at <= ended_at) return at;
  throw std::runtime_error(
      fmt::format("{}: {} of the record is at {} ns; after the one before it and until the end "
                  "of the run it may be at {} to {} ns",
                  run.folder().string(), what, ns, hal::to_ns(after), hal::to_ns(ended_at)));
}

void read_turns(RunReader& run, RecordedCourse& course) {
  Statement query = run.query("SELECT at_ns, process, replied, began FROM turns ORDER BY rowid");
  hal::Time last{};
  while (query.next()) {
    last = checked(query.integer(0), last, fmt::format("turn {}", course.turns.size() + 1), run,
                   course.ended_at);
    course.turns.push_back({last, static_cast<std::size_t>(query.integer(1)), query.integer(2) != 0,
                            query.integer(3) != 0});
  }
}

void read_arrivals(RunReader& run, RecordedCourse& course) {
  Statement query = run.query("SELECT at_ns, door, bytes FROM arrivals ORDER BY rowid");
  hal::Time last{};
  while (query.next()) {
    const std::string what = fmt::format("arrival {}", course.arrivals.size() + 1);
    last = checked(query.integer(0), last, what, run, course.ended_at);
    auto bytes = from_hexadecimal(query.text(2));
    if (!bytes) {
      throw std::runtime_error(fmt::format("{}: {} of the record: '{}' is not hexadecimal",
                                           run.folder().string(), what, query.text(2)));
    }
    course.arrivals.push_back({last, query.text(1), std::move(*bytes)});
  }
}

}  // namespace

std::map<std::string, std::string> read_settings(const std::filesystem::path& folder) {
  RunReader run(folder);
  std::map<std::string, std::string> settings;
  Statement query = run.query("SELECT key, value FROM settings");
  while (query.next()) settings[query.text(0)] = query.text(1);
  return settings;
}

RecordedCourse read_course(const std::filesystem::path& folder) {
  RunReader run(folder);
  const std::string pace = run.value("pace");
  RecordedCourse course;
  course.in_real_time = pace.starts_with("realtime");
  if (!course.in_real_time && pace != "lockstep") {
    throw std::runtime_error(
        fmt::format("{}: not a run in real time, but itself {}", folder.string(), pace));
  }
  if (run.value("ended_ns").empty()) {
    throw std::runtime_error(fmt::format("{}: this run did not end", folder.string()));
  }
  course.ended_at = time_in(run.value("ended_ns"), folder);
  read_turns(run, course);
  read_arrivals(run, course);
  if (course.in_real_time || !course.arrivals.empty()) return course;
  throw std::runtime_error(fmt::format(
      "{}: not a run in real time, and nothing came into it from outside: its scenario and seed "
      "alone repeat it",
      folder.string()));
}

}  // namespace sim::record
