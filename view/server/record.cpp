#include "view/server/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

namespace view::server {

using results::record::Statement;

bool Record::open() {
  if (reader_) return true;
  reader_.emplace(folder_);
  std::string run_id = value("run_id");
  const bool is_same = run_id == run_id_;
  if (!is_same) learn();
  run_id_ = std::move(run_id);
  is_growing_ = reader_->is_unfinished();
  const std::optional<std::int64_t> ended = integer("ended_ns");
  until_ = ended ? *ended : latest_row();
  return is_same;
}

void Record::close_if_growing() {
  if (is_growing_) reader_.reset();
}

void Record::learn() {
  agents_.clear();
  Statement agents = query("SELECT agent FROM agents ORDER BY agent");
  while (agents.next()) agents_.push_back(agents.integer(0));
}

// Rows are written in order of time and committed together: everything before the latest row that
// can be read has been committed.
std::int64_t Record::latest_row() {
  std::int64_t latest = 0;
  const auto look = [&](const std::string& sql) {
    Statement found = query(sql);
    if (found.next()) latest = std::max(latest, found.integer(0));
  };
  for (const char* table :
       {"frame_ends", "queues", "readings", "states", "routes", "contacts", "recorded", "events"}) {
    look(fmt::format("SELECT at_ns FROM {} ORDER BY rowid DESC LIMIT 1", table));
  }
  // By the primary key of each agent: a scan of the whole table would take longer and longer.
  Statement pose = query("SELECT MAX(at_ns) FROM poses WHERE agent = ?");
  for (const std::int64_t agent : agents_) {
    pose.bind_all(agent);
    while (pose.next()) latest = std::max(latest, pose.integer(0));
  }
  return latest;
}

}  // namespace view::server
