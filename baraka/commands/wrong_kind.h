#pragma once

#include <functional>
#include <string>
#include <vector>

namespace baraka::commands {

/// A file as the user named it.
struct NamedFile {
  std::string name;
  /// Of the shared files; see hal::files::config::named_file().
  std::vector<std::string> folders{};
  std::vector<std::string> overrides{};  ///< "key=value".
};

/// Does what a command does with a file. If the file is wrong and clearly of another kind than the
/// command takes, or has no key at all, that is the one mistake that is told; else what
/// with_includes_of() tells.
///
///   return with_file_of("scenario", {options.scenario, {"scenarios"}}, [&] { return run(options);
///   });
///
/// @param kind  of FileKind: what the command takes.
/// @param act   the command. @return what it returns.
/// @throws hal::files::config::ConfigErrors, and whatever `act` throws.
int with_file_of(const std::string& kind, const NamedFile& given, const std::function<int()>& act);

/// Does what a command does with a file of that kind. If something is wrong and the file includes
/// others that are clearly of another kind than belongs there (a radio as a robot), those are the
/// mistakes that are told, a line each.
/// @throws hal::files::config::ConfigErrors, and whatever `act` throws.
int with_includes_of(const std::string& kind, const std::string& file,
                     const std::vector<std::string>& overrides, const std::function<int()>& act);

}  // namespace baraka::commands
