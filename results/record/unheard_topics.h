#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/record/database.h"

namespace results::record {

/// A message class of which no message was delivered to anyone, from the tables of one run.
struct UnheardTopic {
  std::string topic;
  std::vector<std::string> senders = {};  ///< Names, by address.
  std::uint64_t messages = 0;             ///< Number that have ended; those under way do not count.
  std::string verdict = {};               ///< The most frequent outcome.
  std::uint64_t with_verdict = 0;         ///< Messages with that outcome.
};

/// Sorted by topic. A topic whose only messages were still under way at the end is not listed.
/// @throws std::runtime_error  the file cannot be read.
std::vector<UnheardTopic> unheard_topics(Database& database);

/// One line for display: "topic 'ping': none of 119 messages of r0, r1 arrived at anyone; receiver
/// transmitting (119)". Names at most eight senders.
std::string to_line(const UnheardTopic& unheard);

}  // namespace results::record
