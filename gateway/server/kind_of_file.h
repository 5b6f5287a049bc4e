#pragma once

#include <functional>
#include <string>

namespace gateway::server {

/// How a file of a kind (FileKind) is used: "`baraka run FILE` runs it". @param kind  name of the
/// kind.
std::string use_of(const std::string& kind);

/// Runs `act`, what a program does with a hardware file. If the file is wrong and its keys show
/// that it is of another kind, only this mistake is reported. For programs without the readers of
/// all kinds; others use baraka/commands/wrong_kind.h.
/// @return what `act` returns. @throws hal::files::config::ConfigErrors, and whatever `act` throws.
int with_hardware_file(const std::string& file, const std::function<int()>& act);

}  // namespace gateway::server
