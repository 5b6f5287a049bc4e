#pragma once

#include <sys/time.h>

#include <cstdint>
#include <ctime>

#include "programs/preload/dilation.h"

namespace programs::preload {

inline timespec at(std::int64_t time) { return {time / kSecond, time % kSecond}; }
inline timeval at_us(std::int64_t time) { return {time / kSecond, time % kSecond / 1000}; }
inline std::int64_t ns(const timespec& time) { return time.tv_sec * kSecond + time.tv_nsec; }
inline std::int64_t ns(const timeval& time) { return time.tv_sec * kSecond + time.tv_usec * 1000; }

}  // namespace programs::preload
