#include "hal/dds/library_log.h"

#include <fmt/core.h>

#include <memory>
#include <mutex>

#include "hal/dds/fastdds.h"
#include "hal/types/log.h"

namespace hal::dds {
namespace {

std::mutex log_mutex;
std::string last_words;

class ToOurLog : public api::LogConsumer {
  void Consume(const api::Log::Entry& entry) override {
    log::debug(Time{}, "Fast DDS", "{} ({})", entry.message, entry.context.category);
    const std::lock_guard lock(log_mutex);
    last_words = entry.message;
  }
};

}  // namespace

void take_over_library_log() {
  api::Log::ClearConsumers();
  api::Log::RegisterConsumer(std::make_unique<ToOurLog>());
  api::Log::SetVerbosity(api::Log::Kind::Error);
}

std::string last_words_of_library() {
  api::Log::Flush();  // it is written by a thread of its own
  const std::lock_guard lock(log_mutex);
  return last_words.empty() ? std::string() : fmt::format(" (Fast DDS: {})", last_words);
}

}  // namespace hal::dds
