#pragma once

#include <cstddef>
#include <cstdint>

namespace programs::waits {

/// The next 64 bits of this process's entropy: SplitMix64 (G. L. Steele, D. Lea, C. H. Flood,
/// "Fast splittable pseudorandom number generators", OOPSLA 2014), whose start is drawn from the
/// run's seed, the agent and the number of processes that have drawn before. @pre in lock-step.
std::uint64_t draw();

/// Bytes of draw().
void draw(void* bytes, std::size_t count);

/// Of null: no.
bool is_random_device(const char* path);

/// In its place: a file in memory, which is_refilled() makes endless.
/// @param flags  of open(). @return as open().
int open_drawn(int flags);

/// The next draw() begins anew: in a process that fork() has made.
void draw_anew();

/// Whether a file at whose end a program is stands for /dev/urandom: then it is at its beginning,
/// and all of it is drawn anew.
bool is_refilled(int descriptor);

}  // namespace programs::waits
