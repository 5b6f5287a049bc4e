#include "view/server/message_index.h"

#include <algorithm>

namespace view::server {

std::size_t MessageIndex::number_of(const std::string& topic) {
  const auto known = std::ranges::find(topics_, topic);
  if (known == topics_.end()) topics_.push_back(topic);
  return static_cast<std::size_t>(std::ranges::find(topics_, topic) - topics_.begin());
}

const std::vector<MessageIndex::Sent>& MessageIndex::all(Record& record) {
  if (until_ == record.until()) return sent_;
  const auto old = static_cast<std::ptrdiff_t>(sent_.size());
  // Each sender numbers its messages in ascending order.
  auto rows = record.query("SELECT sent_ns, id, topic FROM messages WHERE sender = ? AND id > ?");
  for (const std::int64_t sender : record.agents()) {
    std::int64_t& last = last_.try_emplace(sender, -1).first->second;
    rows.bind_all(sender, last);
    while (rows.next()) {
      sent_.push_back({rows.integer(0), sender, rows.integer(1), number_of(rows.text(2))});
      last = std::max(last, rows.integer(1));
    }
  }
  std::sort(sent_.begin() + old, sent_.end());
  std::inplace_merge(sent_.begin(), sent_.begin() + old, sent_.end());
  until_ = record.until();
  return sent_;
}

}  // namespace view::server
