#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "view/server/record.h"

namespace view::server {

/// The listed messages sorted by the time at which they were sent; the record has them by sender.
class MessageIndex {
 public:
  struct Sent {
    std::int64_t at, sender, id;
    std::size_t topic;  ///< Index in topics().
    auto operator<=>(const Sent&) const = default;
  };

  /// All messages that are in the record now, by time. Reads only what is new since the last call.
  const std::vector<Sent>& all(Record& record);

  const std::vector<std::string>& topics() const { return topics_; }

 private:
  std::size_t number_of(const std::string& topic);

  std::vector<Sent> sent_;
  std::vector<std::string> topics_;
  std::map<std::int64_t, std::int64_t> last_;  ///< Number of the latest message of each sender.
  std::int64_t until_ = -1;                    ///< ns: Record::until() at the last read.
};

}  // namespace view::server
