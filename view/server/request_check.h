#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace view::server {

/// The parts of a request that decide whether it may be answered, as received.
struct RequestHead {
  std::string method, path;
  std::size_t hosts = 0, origins = 0;  ///< How many of these headers it has.
  std::string host, origin;
  std::string fetch_site;  ///< Header Sec-Fetch-Site; empty: none.
  std::string token;       ///< Header X-Baraka-Token; empty: none.
};

struct Refusal {
  int status = 0;   ///< HTTP status.
  std::string why;  ///< For display.
};

/// A browser has pages of many servers open, and each of them can send requests to this one. The
/// header Host has the name by which the browser knows this server; a foreign name that was made to
/// resolve to 127.0.0.1 (DNS rebinding) is refused. The header Origin tells which page makes the
/// request.
/// @param port  of this server.
/// @param token  which every request except that for the page itself must carry. None: no request
/// needs one, and commands are refused.
/// @return none if the request may be answered.
std::optional<Refusal> refusal_of(const RequestHead& request, int port,
                                  const std::optional<std::string>& token);

/// Compares two texts in a time that does not depend on where they differ.
bool equal_in_constant_time(std::string_view a, std::string_view b);

/// 128 random bits in hexadecimal. @throws std::runtime_error  the system has no random numbers.
std::string new_token();

}  // namespace view::server
