#pragma once

namespace programs::netns {

/// Implements `baraka-holder hold`: makes the namespaces of a run and stays until they are gone.
/// Its child, the first process in them, serves baraka.
/// @param control, events  this side's ends of the two sockets.  @param parent  process id of
/// baraka.
/// @return exit status.
int hold(int control, int events, int parent);

}  // namespace programs::netns
