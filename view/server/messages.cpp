#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "view/server/message_index.h"
#include "view/server/row_values.h"
#include "view/server/tiles.h"

namespace view::server {
namespace {

using results::record::Statement;
using Sent = MessageIndex::Sent;

/// A message sent up to this time before a tile can still be on its way in it.
constexpr std::int64_t kOnTheirWay = 60'000'000'000;  // ns

using Range = std::pair<std::vector<Sent>::const_iterator, std::vector<Sent>::const_iterator>;

Range sent_between(const std::vector<Sent>& all, std::int64_t from, std::int64_t to) {
  const auto at = [](const Sent& sent) { return sent.at; };
  return {std::ranges::lower_bound(all, from, {}, at), std::ranges::lower_bound(all, to, {}, at)};
}

Json bins_by_topic(const MessageIndex& index, const Range& range, const Span& span) {
  std::map<std::size_t, Counts> by_topic;
  for (auto sent = range.first; sent != range.second; ++sent) {
    ++by_topic[sent->topic].at(bin_of(span, sent->at));
  }
  JsonArray topics, counts;
  for (const auto& [topic, of_topic] : by_topic) {
    topics.add(index.topics()[topic]);
    counts.add(json_array(of_topic));
  }
  return JsonObject()
      .add("n", kBins)
      .add("topics", topics.json())
      .add("counts", counts.json())
      .json();
}

class MessageRows {
 public:
  explicit MessageRows(Record& record)
      : message_(record.query("SELECT destination, topic, bytes, fate, fate_ns, verdict FROM "
                              "messages WHERE sender = ? AND id = ?")),
        delivery_(record.query("SELECT receiver, at_ns, delay_ns, transmissions FROM deliveries "
                               "WHERE sender = ? AND id = ? ORDER BY at_ns, receiver")) {}

  void add(const Sent& sent) {
    message_.bind_all(sent.sender, sent.id);
    while (message_.next()) {
      columns.add(sent.sender, sent.id, message_.integer(0), message_.text(1), message_.integer(2),
                  sent.at, text_at(message_, 3), integer_at(message_, 4), text_at(message_, 5),
                  deliveries(sent));
    }
  }

  Columns columns{"sender", "id",   "destination", "topic",   "bytes",
                  "sent",   "fate", "fate_at",     "verdict", "deliveries"};

 private:
  Json deliveries(const Sent& sent) {
    JsonArray all;
    delivery_.bind_all(sent.sender, sent.id);
    while (delivery_.next()) {
      all.add(JsonArray()
                  .add(delivery_.integer(0))
                  .add(delivery_.integer(1))
                  .add(delivery_.integer(2))
                  .add(integer_at(delivery_, 3))
                  .json());
    }
    return all.json();
  }

  Statement message_, delivery_;
};

}  // namespace

std::string messages_tile(Record& record, MessageIndex& index, const Span& span) {
  const std::vector<Sent>& all = index.all(record);
  const Range inside = sent_between(all, span.from(), span.to());
  MessageRows rows(record);
  if (inside.second - inside.first > kMostRows) {
    return tile_text(record, span, false, rows.columns,
                     {{"bins", bins_by_topic(index, inside, span)}});
  }
  const Range before = sent_between(all, span.from() - kOnTheirWay, span.from());
  // Only the latest of them, if there are very many.
  const auto count = std::min<std::ptrdiff_t>(before.second - before.first, kMostRows);
  for (auto sent = before.second - count; sent != inside.second; ++sent) rows.add(*sent);
  return tile_text(record, span, true, rows.columns);
}

}  // namespace view::server
