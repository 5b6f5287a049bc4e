#pragma once

#include <optional>
#include <string>

namespace baraka::commands {

/// What the command line of `baraka topic` says.
struct TopicOptions {
  std::string topic;          ///< "rt/clock", or "/clock" or "clock" as in ROS 2.
  std::optional<int> domain;  ///< As topic_domain() says it; never none when it is acted on.
  std::optional<int> count;   ///< Samples; none: until interrupted or the last writer leaves.
  double timeout = 10;        ///< s of wall time, for the topic and then for each sample.
};

// Each prints to standard output and returns the exit status.
// @throws std::runtime_error  if DDS cannot be opened.

/// Topics of a domain, sorted, with type and numbers of writers and readers. Looks for two seconds.
int list_topics(const TopicOptions& options);

// Status kRunFailed, with the topics there are, if there is no such topic in time; and if no sample
// comes in time.

/// Type and endpoints of a topic.
int topic_info(const TopicOptions& options);
/// Samples as YAML documents; those of unknown types in hexadecimal.
int echo_topic(const TopicOptions& options);
/// How often samples come, once a second and at the end.
int topic_rate(const TopicOptions& options);
/// How many bytes come, once a second and at the end.
int topic_bandwidth(const TopicOptions& options);

}  // namespace baraka::commands
