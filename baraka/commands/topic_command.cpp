#include "baraka/commands/topic_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <thread>

#include "baraka/run/pace/interrupts.h"
#include "gateway/inspection/topic_browser.h"
#include "gateway/process/domains.h"
#include "gateway/process/exit_status.h"
#include "hal/types/printable.h"
#include "hal/types/terminal_colours.h"

namespace baraka::commands {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;
using gateway::inspection::RawSample;
using gateway::inspection::SeenTopic;
using gateway::inspection::TopicBrowser;

constexpr auto kLook = 2s;    // time for discovery
constexpr auto kAsk = 100ms;  // interval of checking whether to go on
constexpr auto kReportPeriod = 1s;

/// Possible names of the topic in DDS.
bool is_named(const SeenTopic& topic, const std::string& name) {
  const std::string plain = name.starts_with("/") ? name.substr(1) : name;
  return topic.name == name || topic.name == "rt/" + plain;
}

std::optional<SeenTopic> find(const TopicBrowser& browser, const std::string& name) {
  for (const SeenTopic& topic : browser.topics()) {
    if (is_named(topic, name)) return topic;
  }
  return std::nullopt;
}

/// Waits for the topic and, if requested, for a writer of it.
std::optional<SeenTopic> wait_for(const TopicBrowser& browser, const TopicOptions& options,
                                  bool needs_writer) {
  const auto end = Clock::now() + Seconds(options.timeout);
  while (!run::pace::interrupted()) {
    auto topic = find(browser, options.topic);
    if (topic && (!needs_writer || topic->count(true) > 0)) return topic;
    if (Clock::now() >= end) break;
    std::this_thread::sleep_for(kAsk);
  }
  return std::nullopt;
}

int complain(const TopicBrowser& browser, const TopicOptions& options) {
  if (run::pace::interrupted()) return gateway::process::kInterrupted;
  const auto topics = browser.topics();
  hal::print_line(hal::Tone::kMistake,
                  fmt::format("error: no topic '{}' is published in domain {}; {}",
                              hal::printable(options.topic), options.domain.value(),
                              topics.empty() ? "there are no topics" : "there are:"));
  for (const SeenTopic& topic : topics) {
    fmt::print(stderr, "  {}\n", hal::printable(topic.name));
  }
  return gateway::process::kRunFailed;
}

/// Passes on the samples of a topic until their number is reached, no more arrive, or the user
/// interrupts. @param idle  called at least ten times a second. @return exit status.
int take_samples(const TopicOptions& options,
                 const std::function<void(const RawSample&, const SeenTopic&)>& on_sample,
                 const std::function<void()>& idle) {
  run::pace::catch_interrupts();
  TopicBrowser browser(options.domain.value());
  const auto topic = wait_for(browser, options, true);
  if (!topic) return complain(browser, options);
  const auto subscription = browser.subscribe(*topic);
  auto last = Clock::now();
  int taken = 0;
  while (!options.count || taken < *options.count) {
    if (run::pace::interrupted()) return gateway::process::kInterrupted;
    if (const auto sample = subscription->next(kAsk)) {
      ++taken;
      last = Clock::now();
      on_sample(*sample, *topic);
    } else if (taken > 0 && subscription->writers() == 0) {
      fmt::print(stderr, "the last writer has left\n");
      return options.count ? gateway::process::kRunFailed : gateway::process::kDone;
    } else if (Clock::now() - last > Seconds(options.timeout)) {
      hal::print_line(hal::Tone::kMistake,
                      fmt::format("error: no sample of {} within {} s", hal::printable(topic->name),
                                  options.timeout));
      return gateway::process::kRunFailed;
    }
    idle();
  }
  return gateway::process::kDone;
}

void print_hexadecimal(const RawSample& sample) {
  fmt::print("bytes: {}\nhexadecimal:", sample.bytes.size());
  for (std::size_t i = 0; i < sample.bytes.size(); ++i) {
    fmt::print("{}{:02x}", i % 16 == 0 ? "\n  " : " ", sample.bytes[i]);
  }
  fmt::print("\n");
}

void print_sample(const RawSample& sample, const SeenTopic& topic) {
  if (const auto text = gateway::inspection::to_yaml(topic.type, sample.bytes)) {
    fmt::print("{}---\n", *text);
  } else {
    fmt::print("type: {}\n", hal::printable(topic.type));
    print_hexadecimal(sample);
    fmt::print("---\n");
  }
  std::fflush(stdout);
}

/// Statistics of the intervals between arrivals, and of bytes.
class Traffic {
 public:
  void add(std::size_t bytes) {
    const auto now = Clock::now();
    if (samples_++ > 0) {
      const double interval = Seconds(now - last_).count();
      sum_ += interval;
      squares_ += interval * interval;
      least_ = std::min(least_, interval);
      most_ = std::max(most_, interval);
      bytes_ += bytes;  // the first sample is not counted: it arrived before the measured time
    }
    last_ = now;
  }
  void print_rate() const {
    if (samples_ < 2) return fmt::print("samples: {}\n---\n", samples_);
    const double n = static_cast<double>(samples_ - 1);
    const double mean = sum_ / n;
    fmt::print(
        "samples: {}\nrate_hz: {:.3f}\ninterval_s: {{min: {:.6f}, max: {:.6f}, sd: {:.6f}}}\n---\n",
        samples_, n / sum_, least_, most_, std::sqrt(std::max(0.0, squares_ / n - mean * mean)));
  }
  void print_bandwidth() const {
    if (samples_ < 2) return fmt::print("samples: {}\n---\n", samples_);
    const double n = static_cast<double>(samples_ - 1);
    fmt::print("samples: {}\nbytes_per_s: {:.1f}\nbytes_per_sample: {:.1f}\n---\n", samples_,
               static_cast<double>(bytes_) / sum_, static_cast<double>(bytes_) / n);
  }

 private:
  std::uint64_t samples_ = 0;
  std::uint64_t bytes_ = 0;
  double sum_ = 0, squares_ = 0, least_ = std::numeric_limits<double>::infinity(), most_ = 0;  // s
  Clock::time_point last_{};
};

int measure(const TopicOptions& options, void (Traffic::*print)() const) {
  Traffic traffic;
  auto printed = Clock::now();
  const int status = take_samples(
      options, [&](const RawSample& sample, const SeenTopic&) { traffic.add(sample.bytes.size()); },
      [&] {
        if (options.count || Clock::now() - printed < kReportPeriod) return;
        (traffic.*print)();
        std::fflush(stdout);
        printed = Clock::now();
      });
  if (status != gateway::process::kRunFailed) (traffic.*print)();
  return status;
}

}  // namespace

int list_topics(const TopicOptions& options) {
  const TopicBrowser browser(options.domain.value());
  std::this_thread::sleep_for(kLook);
  const auto topics = browser.topics();
  if (topics.empty()) {
    hal::print_line(
        hal::Tone::kMistake,
        fmt::format(
            "error: no topic is published in domain {}; a run prints `inspect domain: N` as it "
            "begins, --domain N looks there",
            options.domain.value()));
    return gateway::process::kRunFailed;
  }
  for (const SeenTopic& topic : topics) {
    fmt::print("{}  {}  writers: {}  readers: {}\n", hal::printable(topic.name),
               hal::printable(topic.type), topic.count(true), topic.count(false));
  }
  return gateway::process::kDone;
}

int topic_info(const TopicOptions& options) {
  run::pace::catch_interrupts();
  const TopicBrowser browser(options.domain.value());
  if (!wait_for(browser, options, false)) return complain(browser, options);
  std::this_thread::sleep_for(kAsk);  // endpoints are discovered one by one
  const auto found = find(browser, options.topic);
  if (!found) return complain(browser, options);  // it ended just now
  const SeenTopic& topic = *found;
  fmt::print("topic: {}\ntype: {}\nkeyed: {}\n", hal::printable(topic.name),
             hal::printable(topic.type), topic.has_key);
  for (const bool writers : {true, false}) {
    fmt::print("{}:{}\n", writers ? "writers" : "readers", topic.count(writers) == 0 ? " []" : "");
    for (const auto& one : topic.endpoints) {
      if (one.is_writer != writers) continue;
      fmt::print("  - {{participant: {}, reliability: {}, durability: {}}}\n",
                 hal::printable(one.participant), one.is_reliable ? "reliable" : "best_effort",
                 one.durability);
    }
  }
  return gateway::process::kDone;
}

int echo_topic(const TopicOptions& options) {
  return take_samples(options, print_sample, [] {});
}

int topic_rate(const TopicOptions& options) { return measure(options, &Traffic::print_rate); }

int topic_bandwidth(const TopicOptions& options) {
  return measure(options, &Traffic::print_bandwidth);
}

}  // namespace baraka::commands
