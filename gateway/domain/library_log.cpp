#include "gateway/domain/library_log.h"

#include <fmt/core.h>

#include <memory>
#include <mutex>

#include "gateway/guard/fastdds.h"
#include "hal/types/log.h"

namespace gateway::domain {
namespace {

std::mutex log_mutex;
std::string last_words;

class ToOurLog : public guard::api::LogConsumer {
  void Consume(const guard::api::Log::Entry& entry) override {
    hal::log::debug(hal::Time{}, "Fast DDS", "{} ({})", entry.message, entry.context.category);
    const std::lock_guard lock(log_mutex);
    last_words = entry.message;
  }
};

}  // namespace

void take_over_library_log() {
  guard::api::Log::ClearConsumers();
  guard::api::Log::RegisterConsumer(std::make_unique<ToOurLog>());
  guard::api::Log::SetVerbosity(guard::api::Log::Kind::Error);
}

std::string last_words_of_library() {
  guard::api::Log::Flush();  // a separate thread writes the log
  const std::lock_guard lock(log_mutex);
  return last_words.empty() ? std::string() : fmt::format(" (Fast DDS: {})", last_words);
}

}  // namespace gateway::domain
