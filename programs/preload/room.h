#pragma once

#include "programs/netns/room_page.h"
#include "programs/preload/dilation.h"

namespace programs::preload {

/// The page of the agent in which this process runs; null: it runs in none, and nothing is held
/// back.
netns::RoomPage* room();

/// Waits until there may be new room.
/// @param seen  value of room()->change() before the check that found no room.
/// @param longest  of the kernel's time; negative: no limit.
/// @return 0, or ETIMEDOUT, or EINTR.
int wait_for_room(std::uint32_t seen, Nanoseconds longest);

/// Wakes whoever waits for room, because there may be some now.
void wake_for_room();

/// SO_SNDTIMEO of a socket; negative: none.
Nanoseconds send_timeout(int socket);

/// The clock by which wait_for_room() and send_timeout() count.
Nanoseconds time_of_waits();

/// Takes places for data that a socket is about to send, and waits for them as the socket would
/// wait: without limit, up to its SO_SNDTIMEO, or not at all.
/// @param fragments  at least 1. @param flags  of send().
/// @param places  number of places taken: one per fragment, or the whole queue if that has fewer.
/// @return 0, or the error with which the call fails; then no places were taken.
int take_places(int socket, std::uint32_t fragments, int flags, std::uint32_t& places);

/// Returns places after the call. @param is_sent  whether their frames were sent.
void return_places(std::uint32_t places, bool is_sent);

}  // namespace programs::preload
