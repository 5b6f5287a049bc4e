#include "baraka/slurm/queue.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>

namespace baraka::slurm {
namespace {

template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return number;
}

/// Removes the text up to and including the next separator, and returns it without the separator.
std::string_view next_part(std::string_view& text, char separator) {
  const std::size_t at = text.find(separator);
  const std::string_view part = text.substr(0, at);
  text = at == std::string_view::npos ? "" : text.substr(at + 1);
  return part;
}

std::string_view without_spaces(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The word after " KEY=".
std::string_view word_of(std::string_view text, const std::string& key) {
  const std::size_t at = text.starts_with(key + "=") ? 0 : text.find(" " + key + "=");
  if (at == std::string_view::npos) return "";
  text.remove_prefix(text.find('=', at) + 1);
  return text.substr(0, text.find_first_of(" \n"));
}

/// Parses "1-02:03:04", in seconds; the days may be missing.
std::optional<double> seconds_in(std::string_view text) {
  double days = 0;
  if (text.find('-') != std::string_view::npos) {
    days = number_in<int>(next_part(text, '-')).value_or(0);
  }
  const auto hours = number_in<int>(next_part(text, ':'));
  const auto minutes = number_in<int>(next_part(text, ':'));
  const auto seconds = number_in<int>(text);
  if (!hours || !minutes || !seconds) return std::nullopt;
  return ((days * 24 + *hours) * 60 + *minutes) * 60 + *seconds;
}

std::optional<QueuedTask> task_of(std::string_view line) {
  std::string_view rest = line;
  const auto job = number_in<std::int64_t>(next_part(rest, '|'));
  const auto index = number_in<int>(next_part(rest, '|'));
  const std::string_view state = next_part(rest, '|'), name = next_part(rest, '|');
  if (!job || !index || state.empty() || name.empty()) return std::nullopt;
  return QueuedTask{std::string(name), *job, *index, std::string(state), std::string(rest)};
}

}  // namespace

bool JobEnd::has_status(int value) const {
  return (state == "COMPLETED" || state == "FAILED") && signal == 0 && status == value;
}

std::string JobEnd::in_words() const {
  std::string words = state;
  if (!node.empty()) words += " on " + node;
  if (!reason.empty() && reason != "None" && reason != "NonZeroExitCode") {
    words += " (" + reason + ")";
  }
  if (signal != 0) return words + fmt::format(", killed by signal {}", signal);
  if (status != 0) return words + fmt::format(", exit status {}", status);
  return words;
}

hal::Result<std::vector<QueuedTask>> parse_queue(std::string_view printed) {
  std::vector<QueuedTask> tasks;
  while (!printed.empty()) {
    const std::string_view line = without_spaces(next_part(printed, '\n'));
    if (line.empty()) continue;
    std::optional<QueuedTask> task = task_of(line);
    if (!task) {
      return hal::fail(hal::Errc::kProtocol,
                       fmt::format("squeue printed '{}', not job|index|state|name|reason", line));
    }
    tasks.push_back(*std::move(task));
  }
  return tasks;
}

std::optional<JobEnd> parse_job(std::string_view printed) {
  JobEnd end;
  end.state = word_of(printed, "JobState");
  end.reason = word_of(printed, "Reason");
  end.node = word_of(printed, "NodeList");
  if (end.state.empty()) return std::nullopt;
  end.restarts = number_in<int>(word_of(printed, "Restarts")).value_or(0);
  end.wall_s = seconds_in(word_of(printed, "RunTime"));
  if (end.node == "(null)") end.node.clear();
  std::string_view code = word_of(printed, "ExitCode");
  end.status = number_in<int>(next_part(code, ':')).value_or(0);
  end.signal = number_in<int>(code).value_or(0);
  return end;
}

std::optional<std::string> parse_config(std::string_view printed, std::string_view key) {
  while (!printed.empty()) {
    std::string_view line = next_part(printed, '\n');
    if (without_spaces(next_part(line, '=')) == key) return std::string(without_spaces(line));
  }
  return std::nullopt;
}

std::optional<int> parse_processors(std::string_view printed) {
  std::string_view line = without_spaces(next_part(printed, '\n'));
  const auto allocated = number_in<int>(next_part(line, '/'));
  const auto idle = number_in<int>(next_part(line, '/'));
  if (!allocated || !idle) return std::nullopt;
  return *allocated + *idle;
}

std::optional<std::int64_t> parse_submission(std::string_view printed) {
  std::optional<std::int64_t> job;
  while (!printed.empty()) {
    std::string_view line = without_spaces(next_part(printed, '\n'));
    if (const auto number = number_in<std::int64_t>(next_part(line, ';'))) job = number;
  }
  return job;
}

}  // namespace baraka::slurm
