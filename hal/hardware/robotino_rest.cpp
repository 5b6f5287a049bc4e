#include "hal/hardware/robotino_rest.h"

#include <fmt/format.h>
#include <httplib.h>

#include <chrono>
#include <utility>

#include "hal/hardware/json_numbers.h"
#include "hal/types/math.h"

namespace hal::hardware {
namespace {

/// Longest body that is read: some ten times the longest there should be.
constexpr std::size_t kLongestBody = 4096;

Errc code_of(httplib::Error error) {
  switch (error) {
    case httplib::Error::Read:
    case httplib::Error::ConnectionTimeout:
      return Errc::kTimeout;
    case httplib::Error::Canceled:  // by us: the body was too long or too slow
    case httplib::Error::Compression:
    case httplib::Error::ExceedRedirectCount:
      return Errc::kProtocol;
    default:
      return Errc::kNotConnected;
  }
}

}  // namespace

/// The HTTP side: one request, one answer.
class RobotinoRest::Client {
 public:
  explicit Client(const RobotinoSettings& settings)
      : settings_(settings), http_(settings.host, settings.port) {
    const std::chrono::nanoseconds timeout = settings.times.timeout;
    http_.set_connection_timeout(timeout);
    http_.set_read_timeout(timeout);
    http_.set_write_timeout(timeout);
    http_.set_keep_alive(true);
    http_.set_tcp_nodelay(true);
    http_.set_decompress(false);
  }

  Result<std::string> exchange(const char* method, std::string_view name, std::string body) {
    httplib::Request request;
    request.method = method;
    request.path = fmt::format("/data/{}?sid={}", name, settings_.session);
    if (!body.empty()) request.set_header("Content-Type", "application/json");
    request.body = std::move(body);
    const auto deadline = std::chrono::steady_clock::now() + 3 * settings_.times.timeout;
    std::string answer;
    request.content_receiver = [&](const char* bytes, std::size_t size, std::uint64_t,
                                   std::uint64_t) {
      if (answer.size() + size > kLongestBody) return false;
      answer.append(bytes, size);
      return std::chrono::steady_clock::now() < deadline;
    };
    const httplib::Result result = http_.send(request);
    return judged(result, request, std::move(answer));
  }

 private:
  Result<std::string> judged(const httplib::Result& result, const httplib::Request& request,
                             std::string answer) const {
    const auto what = [&] {
      return fmt::format("{} http://{}:{}{}", request.method, settings_.host, settings_.port,
                         request.path);
    };
    if (!result) {
      return fail(code_of(result.error()),
                  fmt::format("{}: {}", what(), httplib::to_string(result.error())));
    }
    if (result->status < 200 || result->status > 299) {
      return fail(Errc::kProtocol, fmt::format("{}: status {}", what(), result->status));
    }
    return answer;
  }

  RobotinoSettings settings_;
  httplib::Client http_;
};

RobotinoRest::RobotinoRest(const RobotinoSettings& settings)
    : client_(std::make_unique<Client>(settings)) {}
RobotinoRest::~RobotinoRest() = default;

Result<void> RobotinoRest::put_velocity(const Twist2& body) {
  const std::array velocity{body.vx, body.vy, body.omega};
  const auto answer = client_->exchange("PUT", "omnidrive", json_numbers(velocity));
  if (!answer) return tl::unexpected<Error>(answer.error());
  return {};
}

Result<RobotinoRest::Odometry> RobotinoRest::odometry() {
  const auto answer = client_->exchange("GET", "odometry", {});
  if (!answer) return tl::unexpected<Error>(answer.error());
  const auto numbers = parse_json_numbers(*answer, 7);
  if (!numbers) return fail(numbers.error().code, "odometry: " + numbers.error().message);
  const std::vector<double>& n = *numbers;
  constexpr double kMaxAngle = 1e8;  // rad: what wrap_angle takes
  if (std::abs(n[2]) > kMaxAngle) {
    return fail(Errc::kProtocol, fmt::format("odometry: a heading of {} rad", n[2]));
  }
  return Odometry{{n[0], n[1], math::wrap_angle(n[2])}, {n[3], n[4], n[5]}, n[6]};
}

Result<std::vector<double>> RobotinoRest::distances() {
  const auto answer = client_->exchange("GET", "distancesensorarray", {});
  if (!answer) return tl::unexpected<Error>(answer.error());
  auto numbers = parse_json_numbers(*answer, kSensors);
  if (!numbers) {
    return fail(numbers.error().code, "distancesensorarray: " + numbers.error().message);
  }
  return numbers;
}

}  // namespace hal::hardware
