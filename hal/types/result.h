#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace hal {

/// What can go wrong at run time on a healthy robot. A caller must be able to act on each one.
enum class Errc {
  kInvalidArgument,  ///< A documented precondition does not hold. Fix the caller.
  kNotAvailable,     ///< This agent has no such sensor, or no reading of it that is young enough.
  kNotConnected,     ///< The process at the other end is gone.
  kTimeout,          ///< The process at the other end lives but did not answer in time.
  kProtocol,         ///< The process at the other end sent something that is against the rules.
  kController,       ///< A controller threw; the message is the controller's.
};

struct Error {
  Errc code;
  std::string message;  ///< One line: what was seen and what was allowed.
};

/// Value or Error. The attribute makes ignoring one a compile error under -Werror.
template <class T>
class [[nodiscard]] Result : public tl::expected<T, Error> {
 public:
  using tl::expected<T, Error>::expected;
};

inline tl::unexpected<Error> fail(Errc code, std::string message) {
  return tl::unexpected<Error>(Error{code, std::move(message)});
}

}  // namespace hal
