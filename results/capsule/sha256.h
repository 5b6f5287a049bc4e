#pragma once

#include <filesystem>
#include <string>

namespace results::capsule {

/// SHA-256 of a file (FIPS 180-4, by OpenSSL), 64 hexadecimal digits, as sha256sum(1) prints it.
/// @throws std::runtime_error  the file cannot be read.
std::string sha256_of(const std::filesystem::path& file);

}  // namespace results::capsule
