#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace view::server {

/// What decides whether a request may be answered at all, as it came.
struct RequestHead {
  std::string method, path;
  std::size_t hosts = 0, origins = 0;  ///< How many such headers it has.
  std::string host, origin;
  std::string fetch_site;  ///< Header Sec-Fetch-Site; empty: none.
  std::string token;       ///< Header X-Baraka-Token; empty: none.
};

struct Refusal {
  int status = 0;   ///< Of HTTP.
  std::string why;  ///< For people.
};

/// A browser has pages of many servers open, and each of them may send requests to this one. The
/// header Host tells what name the browser knows this server by: another one's that was made to
/// point at 127.0.0.1 is refused. The header Origin tells whose page asks.
/// @param port  of this server. @param token  that everything but the page itself must carry; none:
/// nothing needs one, and there are no commands.
/// @return none: it may be answered.
std::optional<Refusal> refusal_of(const RequestHead& request, int port,
                                  const std::optional<std::string>& token);

/// Whether they are equal, in a time that does not tell where they differ.
bool equal_in_constant_time(std::string_view a, std::string_view b);

/// 128 random bits in hexadecimal. @throws std::runtime_error  the system has none.
std::string new_token();

}  // namespace view::server
