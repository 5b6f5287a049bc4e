#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "programs/netns/spaces.h"

namespace programs::netns {

/// A program that is ready for exec.
struct Launch {
  std::string program;                   ///< Path of its file.
  std::vector<std::string> arguments;    ///< The first is its name.
  std::vector<std::string> environment;  ///< NAME=VALUE, the complete environment.
  std::string folder;                    ///< Working folder.
  std::vector<std::string> shown;        ///< Files of the host's /tmp, …: see Shown.
};

/// Starts a program in an agent, as the leader of its own session, without input. It is a child of
/// the calling process.
/// @param log  for its standard output and error. @param inherited  become descriptors 3, 4, …
/// @return its process id in the calling process's namespace.
/// @throws std::runtime_error  what was refused.
pid_t launch(const Launch& launch, const AgentSpaces& spaces, int log,
             const std::vector<int>& inherited);

/// The form that exec takes: with a null pointer at the end. Valid as long as the texts.
std::vector<char*> pointers_to(const std::vector<std::string>& texts);

/// Replaces this process by a program; returns only if that is refused, with errno. If time is
/// slowed, the program and its children get no rights by setuid, setgid or capabilities of files.
void become(const Launch& launch);

/// Raises this process's limit of open descriptors as far as permitted: it needs about ten per
/// agent while they are made, and six from then on. Programs that it starts get the previous limit.
void raise_descriptor_limit();

/// Merges two environments; later variables replace earlier ones of the same name.
std::vector<std::string> merged(const std::vector<std::string>& environment,
                                const std::vector<std::string>& more);

/// The environment for a program inside an agent: `environment` with the library in front of what
/// it preloads, and with the variables for the clock and the room.
std::vector<std::string> inside(const std::vector<std::string>& environment,
                                const std::string& library, const std::string& dilation);

}  // namespace programs::netns
