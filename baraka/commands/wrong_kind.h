#pragma once

#include <functional>
#include <string>
#include <vector>

namespace baraka::commands {

/// A file as the user named it.
struct NamedFile {
  std::string name;
  /// Folders of shared files to search; see hal::files::config::named_file().
  std::vector<std::string> folders{};
  std::vector<std::string> overrides{};  ///< "key=value".
};

/// Carries out a command on a file. If the file has mistakes and is clearly of another kind than
/// the command takes, or has no key at all, only that is reported; otherwise as with_includes_of().
///
///   return with_file_of("scenario", {options.scenario, {"scenarios"}}, [&] { return run(options);
///   });
///
/// @param kind  name of the FileKind that the command takes.
/// @param act  the command.
/// @return the value that `act` returns.
/// @throws hal::files::config::ConfigErrors, and whatever `act` throws.
int with_file_of(const std::string& kind, const NamedFile& given, const std::function<int()>& act);

/// Carries out a command on a file of a kind. If there are mistakes and the file includes others
/// that are clearly of the wrong kind for their place (a radio file as a robot), only these are
/// reported, one line each.
/// @throws hal::files::config::ConfigErrors, and whatever `act` throws.
int with_includes_of(const std::string& kind, const std::string& file,
                     const std::vector<std::string>& overrides, const std::function<int()>& act);

}  // namespace baraka::commands
