#pragma once

#include "programs/netns/room_page.h"
#include "programs/preload/dilation.h"

namespace programs::preload {

/// Of the agent that this process runs in; null: it runs in none, and nothing is held back.
netns::RoomPage* room();

/// Waits until there may be room that was not.
/// @param seen  of room()->change(), before there was found to be none.
/// @param longest  of the kernel's time; negative: for ever.
/// @return 0, or ETIMEDOUT, or EINTR.
int wait_for_room(std::uint32_t seen, Nanoseconds longest);

/// Takes places for what a socket is to send, and waits for them as the socket would: for ever, up
/// to its SO_SNDTIMEO, or not at all.
/// @param fragments  at least 1. @param flags  of send().
/// @param places  how many it took: those of the fragments, or all of the queue if that has fewer.
/// @return 0, or the error that the call ends with; then it took none.
int take_places(int socket, std::uint32_t fragments, int flags, std::uint32_t& places);

/// What became of them.
void return_places(std::uint32_t places, bool is_sent);

}  // namespace programs::preload
