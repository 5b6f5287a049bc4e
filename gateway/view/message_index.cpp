#include "gateway/view/message_index.h"

#include <algorithm>

namespace gateway::view {

const std::vector<MessageIndex::Sent>& MessageIndex::all(Record& record) {
  if (until_ == record.until()) return sent_;
  const auto old = static_cast<std::ptrdiff_t>(sent_.size());
  // Each sender numbers its messages upwards.
  auto rows = record.query("SELECT sent_ns, id FROM messages WHERE sender = ? AND id > ?");
  for (const std::int64_t sender : record.agents()) {
    std::int64_t& last = last_.try_emplace(sender, -1).first->second;
    rows.bind_all(sender, last);
    while (rows.next()) {
      sent_.push_back({rows.integer(0), sender, rows.integer(1)});
      last = std::max(last, rows.integer(1));
    }
  }
  std::sort(sent_.begin() + old, sent_.end());
  std::inplace_merge(sent_.begin(), sent_.begin() + old, sent_.end());
  until_ = record.until();
  return sent_;
}

}  // namespace gateway::view
