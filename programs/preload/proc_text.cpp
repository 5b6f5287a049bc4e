#include "programs/preload/proc_text.h"

#include <unistd.h>

#include <array>
#include <charconv>

#include "programs/preload/process_time.h"

namespace programs::preload {
namespace {

constexpr std::string_view kDigits = "0123456789";

bool is_number(std::string_view word) {
  return !word.empty() && word.find_first_not_of(kDigits) == std::string_view::npos;
}

/// Removes and returns the next component of a path, up to a slash.
std::string_view take_part(std::string_view& path) {
  const std::string_view part = path.substr(0, path.find('/'));
  path.remove_prefix(std::min(path.size(), part.size() + 1));
  return part;
}

void append(std::string& text, Nanoseconds number) {
  std::array<char, 24> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  text.append(digits.data(), end);
}

std::optional<Nanoseconds> number_of(std::string_view word) {
  Nanoseconds value = 0;
  if (!is_number(word)) return std::nullopt;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{}) return std::nullopt;
  return value;
}

/// Length of a clock tick, usually a hundredth of a second.
Nanoseconds length_of_tick() { return kSecond / sysconf(_SC_CLK_TCK); }

Nanoseconds processor_time(Nanoseconds ticks) {
  return ProcessTime::get().dilation().to_program(ticks);
}

/// Converts a time since the computer's start, in units of `length`.
Nanoseconds since_start(Nanoseconds count, Nanoseconds length) {
  return ProcessTime::get().to_program(count * length, CLOCK_BOOTTIME) / length;
}

/// Replaces the numbers of a text, beginning with number `i`; the other text is unchanged.
template <class Replacement>
std::string with_numbers(std::string_view text, int i, Replacement replacement) {
  std::string told;
  told.reserve(text.size());
  while (!text.empty()) {
    const std::string_view between = text.substr(0, text.find_first_not_of(" \n"));
    told += between;
    text.remove_prefix(between.size());
    const std::string_view word = text.substr(0, text.find_first_of(" \n"));
    text.remove_prefix(word.size());
    const auto number = number_of(word);
    if (number) append(told, replacement(i, *number));
    if (!number) told += word;
    if (!word.empty()) ++i;
  }
  return told;
}

/// "350735.47 234388.90": seconds since the start, and idle time of all processors.
std::string uptime(std::string_view kernel) {
  constexpr Nanoseconds kHundredth = kSecond / 100;
  const std::size_t point = kernel.find('.');
  const std::size_t blank = kernel.find(' ');
  const std::size_t second_point = kernel.find('.', blank);
  const auto number = [&](std::size_t begin, std::size_t at) -> std::optional<Nanoseconds> {
    const auto whole = number_of(kernel.substr(begin, at - begin));
    const auto places = number_of(kernel.substr(at + 1, 2));
    if (!whole || !places) return std::nullopt;
    return *whole * 100 + *places;
  };
  if (point == kernel.npos || blank == kernel.npos || second_point == kernel.npos) {
    return std::string(kernel);
  }
  const auto up = number(0, point), idle = number(blank + 1, second_point);
  if (!up || !idle) return std::string(kernel);
  std::string told;
  const auto put = [&told](Nanoseconds hundredths) {
    append(told, hundredths / 100);
    told += '.';
    told += kDigits[static_cast<std::size_t>(hundredths / 10 % 10)];
    told += kDigits[static_cast<std::size_t>(hundredths % 10)];
  };
  put(since_start(*up, kHundredth));
  told += ' ';
  put(processor_time(*idle));
  return told + '\n';
}

/// Lines that begin with `cpu`: ticks of all processors together and of each one.
std::string stat(std::string_view kernel) {
  std::string told;
  told.reserve(kernel.size());
  while (!kernel.empty()) {
    const std::string_view line =
        kernel.substr(0, std::min(kernel.find('\n'), kernel.size() - 1) + 1);
    kernel.remove_prefix(line.size());
    if (line.substr(0, 3) == "cpu") {
      told += with_numbers(line, 0, [](int, Nanoseconds ticks) { return processor_time(ticks); });
    } else {
      told += line;
    }
  }
  return told;
}

/// The second field is the program's name in brackets, which may contain anything.
std::string process(std::string_view kernel) {
  const std::size_t behind = kernel.rfind(')');
  if (behind == kernel.npos) return std::string(kernel);
  constexpr int kFirst = 3;
  std::string told(kernel.substr(0, behind + 1));
  told += with_numbers(kernel.substr(behind + 1), kFirst, [](int field, Nanoseconds number) {
    constexpr int kUser = 14, kSystemOfChildren = 17, kStart = 22, kWaiting = 42, kGuests = 44;
    const bool is_time =
        (field >= kUser && field <= kSystemOfChildren) || (field >= kWaiting && field <= kGuests);
    if (field == kStart) return since_start(number, length_of_tick());
    return is_time ? processor_time(number) : number;
  });
  return told;
}

}  // namespace

std::optional<ProcFile> proc_file(std::string_view path) {
  constexpr std::string_view kRoot = "/proc/";
  if (path.substr(0, kRoot.size()) != kRoot) return std::nullopt;
  path.remove_prefix(kRoot.size());
  if (path == "uptime") return ProcFile::kUptime;
  if (path == "stat") return ProcFile::kStat;
  if (!is_number(take_part(path))) return std::nullopt;
  if (path == "stat") return ProcFile::kProcess;
  if (take_part(path) != "task" || !is_number(take_part(path)) || path != "stat") {
    return std::nullopt;
  }
  return ProcFile::kProcess;
}

bool may_be_proc_file(std::string_view path) {
  const std::string_view last = path.substr(path.rfind('/') + 1);
  return last == "uptime" || last == "stat";
}

std::string as_told(ProcFile file, std::string_view kernel) {
  switch (file) {
    case ProcFile::kUptime:
      return uptime(kernel);
    case ProcFile::kStat:
      return stat(kernel);
    case ProcFile::kProcess:
      return process(kernel);
  }
  return std::string(kernel);
}

}  // namespace programs::preload
