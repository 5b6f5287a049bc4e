#pragma once

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "gateway/process/domains.h"

/// A DDS domain that this process has to its end, and no other test. Not one of take_domain(): that
/// is free again as soon as its server is gone, and a controller that ends a moment later would
/// still say Hello to the server of the next test. End-to-end tests have 41 to 70.
inline int test_domain() {
  static const int domain = [] {
    for (int candidate = 71; candidate <= 100; ++candidate) {
      const auto path = std::filesystem::temp_directory_path() /
                        fmt::format("baraka-test-domain-{}.lock", candidate);
      const int lock = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
      if (lock >= 0 && flock(lock, LOCK_EX | LOCK_NB) == 0) {
        try {
          return gateway::process::take_domain(candidate).domain();  // and let go: it can be had
        } catch (const std::runtime_error&) {  // somebody is on its ports who knows no lock
        }
      }
      close(lock);
    }
    throw std::runtime_error("all DDS domains of tests are taken");
  }();
  return domain;
}
