#pragma once

#include <functional>
#include <string>

namespace gateway::server {

/// What takes a file of a kind (FileKind): "`baraka run FILE` runs it". @param kind  one of those.
std::string use_of(const std::string& kind);

/// Does what a program does with a hardware file. If the file is wrong and clearly of another kind,
/// by keys that only that has, this is the one mistake that is told. For programs without the
/// readers of all kinds; others have baraka/commands/wrong_kind.h.
/// @return what `act` returns. @throws hal::files::config::ConfigErrors, and whatever `act` throws.
int with_hardware_file(const std::string& file, const std::function<int()>& act);

}  // namespace gateway::server
