#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace hal {

/// Errors at run time that a caller can handle.
enum class Errc {
  kInvalidArgument,  ///< A documented precondition does not hold. Fix the caller.
  kNotAvailable,     ///< The agent has no such sensor, or no reading of it that is recent enough.
  kNotConnected,     ///< The peer process has ended.
  kTimeout,          ///< The peer process is alive but did not answer in time.
  kProtocol,         ///< The peer process violated the protocol.
  kController,       ///< A controller threw an exception; the message is that of the exception.
};

/// Why a call failed.
struct Error {
  Errc code;            ///< For the program.
  std::string message;  ///< For people, one line: what was seen and what was allowed.
};

/// Value or Error. The attribute makes ignoring one a compile error under -Werror.
template <class T>
class [[nodiscard]] Result : public tl::expected<T, Error> {
 public:
  using tl::expected<T, Error>::expected;
};

/// A failed Result: `return fail(Errc::kTimeout, "…");`.
inline tl::unexpected<Error> fail(Errc code, std::string message) {
  return tl::unexpected<Error>(Error{code, std::move(message)});
}

}  // namespace hal
