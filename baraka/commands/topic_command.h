#pragma once

#include <optional>
#include <string>

namespace baraka::commands {

/// The command line of `baraka topic`.
struct TopicOptions {
  std::string file;           ///< Of topics_from().
  std::string topic;          ///< "rt/clock", or "/clock" or "clock" as in ROS 2.
  std::optional<int> domain;  ///< Set by topic_domain() before the functions below are called.
  std::optional<int> count;   ///< Samples; none: until interrupted or the last writer leaves.
  double timeout = 10;        ///< s, wall time to wait for the topic and then for each sample.
};

// Each prints to standard output and returns the exit status.
// @throws std::runtime_error  if DDS cannot be opened.

/// Lists the topics of a domain, sorted, with type and numbers of writers and readers. Takes two
/// seconds for discovery.
int list_topics(const TopicOptions& options);

// The following return kRunFailed if the topic does not appear in time (then they list the topics
// that exist) or if no sample arrives in time.

/// Prints type and endpoints of a topic.
int topic_info(const TopicOptions& options);
/// Prints samples as YAML documents; samples of unknown types in hexadecimal.
int echo_topic(const TopicOptions& options);
/// Prints the rate of samples, once a second and at the end.
int topic_rate(const TopicOptions& options);
/// Prints the rate of bytes, once a second and at the end.
int topic_bandwidth(const TopicOptions& options);

}  // namespace baraka::commands
