#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <tuple>

#include "sim/radio/observer.h"
#include "sim/record/database.h"

namespace sim::record {

/// Numbers that grow during a run, kept here and written now and then.
template <class Key>
class Counts {
 public:
  void add(const Key& key) { ++entries_[key].count; }

  /// Calls write(key, count) for each entry that grew since the last call.
  template <class Write>
  void write_changes(Write write) {
    for (auto& [key, entry] : entries_) {
      if (entry.count == entry.written) continue;
      write(key, entry.count);
      entry.written = entry.count;
    }
  }

 private:
  struct Entry {
    std::uint64_t count = 0;
    std::uint64_t written = 0;
  };
  std::map<Key, Entry> entries_;
};

/// The tables frames_sent, receptions, packets and requests.
class FrameCounts {
 public:
  explicit FrameCounts(Database& database);

  void on_frame_start(const radio::Frame& frame);
  void on_reception(const radio::Frame& frame, hal::AgentId receiver, hal::Verdict verdict);
  void on_delivered(const radio::Frame& frame, hal::AgentId receiver);
  void on_request_end(hal::AgentId sender, hal::AgentId destination, hal::Verdict verdict);

  void write();

 private:
  using Pair = std::pair<hal::AgentId, hal::AgentId>;
  Statement put_sent_, put_reception_, put_packet_, put_request_;
  Counts<std::tuple<Pair, std::string_view>> sent_;
  Counts<std::tuple<Pair, std::string_view, bool, hal::Verdict>> receptions_;
  Counts<std::tuple<Pair, std::string_view>> packets_;
  Counts<std::tuple<Pair, hal::Verdict>> requests_;
};

}  // namespace sim::record
