#include "programs/topics/journal.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace programs::topics {

Journal::Journal(std::string participant, const std::filesystem::path& file)
    : participant_(std::move(participant)), out_(file) {
  if (!out_) throw std::runtime_error(file.string() + ": cannot be written");
}

void Journal::wrote(const std::string& topic, bool was_accepted, std::int64_t late_ns) {
  const std::lock_guard lock(mutex_);
  if (is_closed_) return;
  Written& count = written_[topic];
  ++(was_accepted ? count.samples : count.refused);
  count.latest_ns = std::max(count.latest_ns, late_ns);
}

void Journal::received(const std::string& topic, const std::string& writer, std::int64_t at_ns) {
  const std::lock_guard lock(mutex_);
  if (is_closed_) return;
  Received& count = received_[{topic, writer}];
  if (count.samples++ == 0) count.first_ns = at_ns;
  count.last_ns = at_ns;
}

void Journal::add_written(const std::string& topic) {
  const std::lock_guard lock(mutex_);
  written_.try_emplace(topic);
}

bool Journal::close() {
  const std::lock_guard lock(mutex_);
  is_closed_ = true;
  nlohmann::json out = {{"participant", participant_},
                        {"written", nlohmann::json::array()},
                        {"received", nlohmann::json::array()}};
  for (const auto& [topic, count] : written_) {
    out["written"].push_back({{"topic", topic},
                              {"samples", count.samples},
                              {"refused", count.refused},
                              {"latest_ns", count.latest_ns}});
  }
  for (const auto& [from, count] : received_) {
    out["received"].push_back({{"topic", from.first},
                               {"writer", from.second},
                               {"samples", count.samples},
                               {"first_ns", count.first_ns},
                               {"last_ns", count.last_ns}});
  }
  out_ << out.dump(1) << '\n' << std::flush;
  return out_.good();
}

}  // namespace programs::topics
