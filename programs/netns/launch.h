#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "programs/netns/spaces.h"

namespace programs::netns {

/// A program, ready for exec.
struct Launch {
  std::string program;                   ///< Its file.
  std::vector<std::string> arguments;    ///< The first is its name.
  std::vector<std::string> environment;  ///< NAME=VALUE, all of it.
  std::string folder;                    ///< Where it works.
  std::vector<std::string> shown;        ///< Of the host's /tmp, …: see Shown.
};

/// Starts a program in an agent, as the leader of a session of its own, with no input. It is a
/// child of the calling process.
/// @param log  its standard output and error. @param inherited  become 3, 4, …
/// @return its process number, as seen from the calling process. @throws std::runtime_error  what
/// it was refused.
pid_t launch(const Launch& launch, const AgentSpaces& spaces, int log,
             const std::vector<int>& inherited);

/// What exec takes: null behind the last. Valid as long as the texts.
std::vector<char*> pointers_to(const std::vector<std::string>& texts);

/// Becomes a program; returns only if that is refused, with errno. Where its time is slowed, it and
/// what it starts get no rights by setuid, setgid or capabilities of files.
void become(const Launch& launch);

/// This process may open as many descriptors as it is allowed at all, about ten for each agent
/// while they are made and six from then on; programs that it starts get the limit that it had.
void raise_descriptor_limit();

/// The variables of an environment, of which later ones replace earlier ones of the same name.
std::vector<std::string> merged(const std::vector<std::string>& environment,
                                const std::vector<std::string>& more);

/// What a program inside an agent needs beside its own environment: what to preload, in front of
/// what `environment` has, and where clock and room are.
std::vector<std::string> inside(const std::vector<std::string>& environment,
                                const std::string& library, const std::string& dilation);

}  // namespace programs::netns
