#pragma once

namespace programs::netns {

/// What `baraka-holder hold` does: makes the namespaces of a run and stays until they are gone. Its
/// child, the first process in them, is the one that serves baraka.
/// @param control, events  its ends of the two sockets.  @param parent  process number of baraka.
/// @return exit status.
int hold(int control, int events, int parent);

}  // namespace programs::netns
