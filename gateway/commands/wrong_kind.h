#pragma once

#include <functional>
#include <string>
#include <vector>

namespace gateway {

/// Does what a command does with a file. If the file is wrong and clearly of another kind than the
/// command takes, or has no key at all, that is the one mistake that is told.
///
///   return with_file_of("scenario", options.scenario, {"scenarios"}, [&] { return run(options);
///   });
///
/// @param kind     of FileKind: what the command takes.
/// @param given    the file, as the user named it.
/// @param folders  of the shared files, where it is looked for; see hal::config::named_file().
/// @param act      the command. @return what it returns.
/// @throws hal::config::ConfigErrors, and whatever `act` throws.
int with_file_of(const std::string& kind, const std::string& given,
                 const std::vector<std::string>& folders, const std::function<int()>& act);

}  // namespace gateway
