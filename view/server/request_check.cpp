#include "view/server/request_check.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <stdexcept>

namespace view::server {
namespace {

constexpr std::string_view kPagePath = "/";
constexpr std::string_view kControlPath = "/api/control";

bool is_of_this_server(std::string_view host, int port) {
  return host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port);
}

std::optional<Refusal> refusal_of_stranger(const RequestHead& request,
                                           const std::optional<std::string>& token) {
  const bool is_command = request.method == "POST" && request.path == kControlPath;
  if (request.method != "GET" && !is_command) return Refusal{405, "only GET is answered here"};
  if (is_command && !token) {
    return Refusal{403, "commands are taken by `baraka run … --view` only"};
  }
  // The page itself has no data of the run, and a browser cannot send a token when it opens an
  // address.
  if (!token || request.path == kPagePath) return std::nullopt;
  if (!equal_in_constant_time(request.token, *token)) {
    return Refusal{403, "the token is not the one of the address that was printed"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Refusal> refusal_of(const RequestHead& request, int port,
                                  const std::optional<std::string>& token) {
  if (request.hosts != 1 || !is_of_this_server(request.host, port)) {
    return Refusal{421,
                   fmt::format("the header Host must be 127.0.0.1:{0} or localhost:{0}", port)};
  }
  if (request.origins > 1 || (request.origins == 1 && request.origin != "http://" + request.host)) {
    return Refusal{403, "pages of other servers may not ask"};
  }
  // A link in another page may lead to this page; that page may not load the answers as scripts or
  // images.
  const bool is_foreign = request.fetch_site == "cross-site" || request.fetch_site == "same-site";
  if (is_foreign && request.path != kPagePath)
    return Refusal{403, "pages of other servers may not ask"};
  return refusal_of_stranger(request, token);
}

bool equal_in_constant_time(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    different |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  }
  return different == 0;
}

std::string new_token() {
  std::array<unsigned char, 16> bits{};
  if (::getrandom(bits.data(), bits.size(), 0) != static_cast<ssize_t>(bits.size())) {
    throw std::runtime_error("view: the system has no random numbers for a token");
  }
  std::string token;
  for (const unsigned char byte : bits) token += fmt::format("{:02x}", byte);
  return token;
}

}  // namespace view::server
