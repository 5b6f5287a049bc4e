#include "baraka/commands/robot_from.h"

#include <fmt/format.h>

#include "gateway/process/exit_status.h"
#include "hal/files/config/errors.h"
#include "hal/files/config/model_reader.h"

namespace baraka::commands {

int robot_from(const RobotFromOptions& options) {
  std::vector<std::string> words;
  for (const std::string& folder : options.folders)
    words.insert(words.end(), {"--robot-path", folder});
  if (!options.drive.empty()) words.insert(words.end(), {"--drive", options.drive});
  if (!options.model.empty()) words.insert(words.end(), {"--model", options.model});
  words.push_back(options.file);
  const auto reading = hal::files::config::read_model(words);
  if (!reading.mistakes.empty()) throw hal::files::config::ConfigErrors(reading.mistakes);
  fmt::print("{}", reading.yaml);
  return gateway::process::kDone;
}

}  // namespace baraka::commands
