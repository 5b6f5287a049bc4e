#include "baraka/commands/topic_from.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "baraka/commands/recorded_rhythm.h"
#include "gateway/process/exit_status.h"
#include "hal/files/config/value.h"
#include "hal/types/printable.h"
#include "results/report/text_table.h"

namespace baraka::commands {
namespace {

using hal::TopicQos;
using hal::files::recording::RecordedFlow;
using hal::files::recording::RecordedSample;
using hal::files::recording::RecordedTopic;
using hal::files::recording::Recording;
using Kind = RecordedRhythm::Kind;

constexpr std::uint32_t kLeastSize = 8;  // octets, what the key accepts

std::string yaml_quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string bytes_text(std::uint64_t bytes) {
  return bytes > 0 && bytes % 1000 == 0 ? fmt::format("{} kB", bytes / 1000)
                                        : fmt::format("{} B", bytes);
}

std::string time_text(double seconds) {
  if (seconds >= 1) return fmt::format("{:.4g} s", seconds);
  if (seconds >= 1e-3) return fmt::format("{:.4g} ms", seconds * 1e3);
  return seconds < 1e-9 ? "0 s" : fmt::format("{:.4g} us", seconds * 1e6);
}

/// @param digits  significant ones, without an exponent.
std::string rate_text(double rate, int digits) {
  return rate >= 1000 ? fmt::format("{:.0f} Hz", rate) : fmt::format("{:.{}g} Hz", rate, digits);
}

std::string reliability_text(const TopicQos& qos) {
  return qos.reliability == TopicQos::Reliability::kReliable ? "reliable" : "best_effort";
}
std::string durability_text(const TopicQos& qos) {
  return qos.durability == TopicQos::Durability::kVolatile ? "volatile" : "transient_local";
}
std::string depth_text(const TopicQos& qos) {
  return qos.depth ? std::to_string(*qos.depth) : "all";
}
std::string deadline_text(hal::Duration deadline) {
  return hal::files::config::readable(hal::to_seconds(deadline), "s");
}

std::string qos_text(const std::optional<TopicQos>& qos) {
  if (!qos) return "-";
  return fmt::format("{}, {}, {}{}", reliability_text(*qos), depth_text(*qos),
                     durability_text(*qos),
                     qos->deadline ? ", deadline " + deadline_text(*qos->deadline) : "");
}

std::uint64_t sum_of(const std::vector<RecordedSample>& samples) {
  std::uint64_t sum = 0;
  for (const RecordedSample& one : samples) sum += one.bytes;
  return sum;
}

/// Samples, rate, gaps, sizes and share of one row.
void add_numbers(std::vector<std::string>& row, const std::vector<RecordedSample>& samples,
                 std::uint64_t all) {
  row.push_back(std::to_string(samples.size()));
  if (samples.empty()) {
    row.insert(row.end(), {"-", "-", "-", "-", "-", "-"});
    return;
  }
  const RecordedRhythm rhythm = rhythm_of(samples);
  const bool has_rate = rhythm.mean_rate > 0;
  row.push_back(has_rate ? rate_text(rhythm.mean_rate, 4) : "-");
  row.push_back(has_rate ? time_text(rhythm.gap_sd) : "-");
  const RecordedSizes sizes = sizes_of(samples);
  for (const std::uint32_t size : {sizes.least, sizes.median, sizes.most})
    row.push_back(std::to_string(size));
  row.push_back(fmt::format("{:.1f} %", 100.0 * static_cast<double>(sizes.sum) /
                                            static_cast<double>(std::max<std::uint64_t>(all, 1))));
}

std::string table_of(const Recording& recording) {
  std::uint64_t all = 0;
  for (const RecordedTopic& topic : recording.topics) all += sum_of(topic.samples);
  for (const RecordedFlow& flow : recording.flows) all += sum_of(flow.datagrams);
  results::report::TextTable table({"topic", "type", "samples", "rate", "sd of gaps", "least B",
                                    "median B", "most B", "share", "QoS"});
  for (const RecordedTopic& topic : recording.topics) {
    std::vector<std::string> row{topic.name, topic.type.empty() ? "-" : topic.type};
    add_numbers(row, topic.samples, all);
    row.push_back(qos_text(topic.qos));
    table.add_row(std::move(row));
  }
  for (const RecordedFlow& flow : recording.flows) {
    std::vector<std::string> row{fmt::format("UDP to port {}", flow.port), "-"};
    add_numbers(row, flow.datagrams, all);
    row.push_back("-");
    table.add_row(std::move(row));
  }
  return table.text();
}

std::string commented(std::string_view lines) {
  std::string result;
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size() - 1);
    result += fmt::format("# {}\n", lines.substr(0, end + (lines[end] == '\n' ? 0 : 1)));
    lines.remove_prefix(end + 1);
  }
  return result;
}

/// Name as `from` gives it to each agent's own topic: rt/scan of r0 becomes rt/r0/scan.
std::string name_of_agent(const std::string& name) {
  constexpr std::string_view kRos = "rt/";
  const std::size_t begin = name.starts_with(kRos) ? kRos.size() : 0;
  return fmt::format("{}{{agent}}/{}", name.substr(0, begin), name.substr(begin));
}

std::string size_text(const RecordedSizes& sizes) {
  std::string list;
  for (const std::uint32_t size : sizes.in_turn) {
    list += fmt::format("{}{}", list.empty() ? "" : ", ", bytes_text(std::max(size, kLeastSize)));
  }
  return sizes.in_turn.size() == 1 ? list : "[" + list + "]";
}

std::string rhythm_text(const RecordedRhythm& rhythm) {
  switch (rhythm.kind) {
    case Kind::kPeriodic: {
      std::string text = fmt::format("    rate: {}\n", rate_text(rhythm.rate, 5));
      // Below a microsecond it is what nanoseconds were rounded to.
      if (rhythm.jitter >= 1e-6) text += fmt::format("    jitter: {}\n", time_text(rhythm.jitter));
      return text;
    }
    case Kind::kPoisson:
      return fmt::format("    poisson: {}  # gaps: sd / mean = {:.2f}\n", rate_text(rhythm.rate, 5),
                         rhythm.gap_sd / rhythm.gap_mean);
    case Kind::kBursts:
      return fmt::format("    bursts: {{rate: {}, samples: {}, spacing: {}}}\n",
                         rate_text(rhythm.rate, 5), rhythm.samples, time_text(rhythm.spacing));
    case Kind::kFew:
      break;
  }
  return {};
}

std::string qos_keys(const std::optional<TopicQos>& told) {
  const TopicQos qos = told.value_or(TopicQos{});
  std::string text = fmt::format("    reliability: {}{}\n    history: {}\n    durability: {}\n",
                                 reliability_text(qos), told ? "" : "  # QoS is not recorded",
                                 depth_text(qos), durability_text(qos));
  if (qos.deadline) text += fmt::format("    deadline: {}\n", deadline_text(*qos.deadline));
  return text;
}

std::string item_of(const RecordedTopic& topic, const std::string& file) {
  const std::string type = topic.type.empty() ? "" : ", " + topic.type;
  if (topic.samples.empty()) return fmt::format("  # {}{}: no sample\n", topic.name, type);
  const RecordedRhythm rhythm = rhythm_of(topic.samples);
  if (rhythm.kind == Kind::kFew) {
    return fmt::format(
        "  - from: {}  # {} sample{}, no rate: the recording itself\n    name: {}{}\n"
        "    readers: ['*']\n",
        yaml_quoted(file), topic.samples.size(), topic.samples.size() == 1 ? "" : "s",
        yaml_quoted(topic.name), type.empty() ? "" : "  # " + topic.type);
  }
  return fmt::format("  - name: {}  # {}{}\n    size: {}\n{}{}    readers: ['*']\n",
                     yaml_quoted(name_of_agent(topic.name)), topic.name, type,
                     size_text(sizes_of(topic.samples)), rhythm_text(rhythm), qos_keys(topic.qos));
}

}  // namespace

std::string recording_page(const Recording& recording, const std::string& file) {
  std::string page = fmt::format("# {}: {:.3f} s\n", file, hal::to_seconds(recording.length));
  page += commented(table_of(recording));
  for (const std::string& note : recording.notes) page += commented(note);
  page += recording.topics.empty() ? "topics: []\n" : "topics:\n";
  for (const RecordedTopic& topic : recording.topics) page += item_of(topic, file);
  return page;
}

int topics_from(const TopicOptions& options) {
  const Recording recording = hal::files::recording::read_recording(options.file);
  const std::string file = std::filesystem::absolute(options.file).lexically_normal().string();
  fmt::print("{}", recording_page(recording, hal::printable(file)));
  return gateway::process::kDone;
}

}  // namespace baraka::commands
