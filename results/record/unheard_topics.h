#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/record/database.h"

namespace results::record {

/// A message class of which nothing arrived at anyone, from the tables of one run.
struct UnheardTopic {
  std::string topic;
  std::vector<std::string> senders = {};  ///< Names, by address.
  std::uint64_t messages = 0;             ///< That ended: those still on their way do not count.
  std::string verdict = {};               ///< How most of them ended.
  std::uint64_t with_verdict = 0;         ///< So many of them.
};

/// By topic. Messages that were on their way at the end do not make a topic unheard.
/// @throws std::runtime_error if the file cannot be read.
std::vector<UnheardTopic> unheard_topics(Database& database);

/// One line for people: "topic 'ping': none of 119 messages of r0, r1 arrived at anyone; receiver
/// transmitting (119)". Names at most eight senders.
std::string to_line(const UnheardTopic& unheard);

}  // namespace results::record
