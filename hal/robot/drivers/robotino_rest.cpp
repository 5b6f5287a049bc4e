#include "hal/robot/drivers/robotino_rest.h"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <functional>
#include <utility>

#include "hal/robot/drivers/bounded_client.h"
#include "hal/robot/drivers/json_numbers.h"
#include "hal/types/math.h"

namespace hal::robot::drivers {
namespace {

/// Longest body that is read: about ten times the longest expected one.
constexpr std::size_t kLongestBody = 4096;

/// Longest answer, including the head.
constexpr std::size_t kLongestAnswer = 16384;

Errc code_of(httplib::Error error) {
  switch (error) {
    case httplib::Error::Read:
    case httplib::Error::ConnectionTimeout:
      return Errc::kTimeout;
    case httplib::Error::Canceled:  // by this program: the body was too long
    case httplib::Error::Compression:
    case httplib::Error::ExceedRedirectCount:
      return Errc::kProtocol;
    default:
      return Errc::kNotConnected;
  }
}

}  // namespace

/// The HTTP client: one request, one answer.
class RobotinoRest::Client {
 public:
  explicit Client(const RobotinoSettings& settings)
      : settings_(settings),
        http_(settings.host, settings.port,
              {.time = settings.times.timeout, .bytes = kLongestAnswer}) {
    const std::chrono::nanoseconds timeout = settings.times.timeout;
    http_.set_connection_timeout(timeout);
    http_.set_keep_alive(true);
    http_.set_tcp_nodelay(true);
    http_.set_decompress(false);
  }

  Result<std::string> get(std::string_view name) {
    httplib::Request request;
    request.method = "GET";
    return exchange(name, request);
  }

  /// @param body  called right before it is written; returns `length` bytes.
  Result<std::string> put(std::string_view name, std::size_t length,
                          const std::function<std::string_view()>& body) {
    httplib::Request request;
    request.method = "PUT";
    request.set_header("Content-Type", "application/json");
    request.content_length_ = length;
    request.content_provider_ = [&](std::size_t offset, std::size_t, httplib::DataSink& sink) {
      const std::string_view rest = body().substr(offset);
      return sink.write(rest.data(), rest.size());
    };
    return exchange(name, request);
  }

 private:
  Result<std::string> exchange(std::string_view name, httplib::Request& request) {
    request.path = fmt::format("/data/{}?sid={}", name, settings_.session);
    std::string answer;
    request.content_receiver = [&](const char* bytes, std::size_t size, std::uint64_t,
                                   std::uint64_t) {
      if (answer.size() + size > kLongestBody) return false;
      answer.append(bytes, size);
      return true;
    };
    const httplib::Result result = http_.send(request);
    return judged(result, request, std::move(answer));
  }

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
  BoundedClient http_;
};

RobotinoRest::RobotinoRest(const RobotinoSettings& settings)
    : client_(std::make_unique<Client>(settings)) {}
RobotinoRest::~RobotinoRest() = default;

Result<Twist2> RobotinoRest::put_velocity(const TimedVelocity& velocity) {
  const auto text_of = [](const Twist2& t) {
    return json_numbers(std::array{t.vx, t.vy, t.omega});
  };
  std::string moving = text_of(velocity.body);
  std::string standing = text_of({});
  // The header states the length before it is known which of the two will be written.
  const std::size_t length = std::max(moving.size(), standing.size());
  moving.resize(length, ' ');
  standing.resize(length, ' ');
  Twist2 written;
  const auto answer = client_->put("omnidrive", length, [&]() -> std::string_view {
    written = velocity.at(platform::BootClock::now());
    return written == Twist2{} ? standing : moving;
  });
  if (!answer) return tl::unexpected<Error>(answer.error());
  return written;
}

Result<RobotinoRest::Odometry> RobotinoRest::odometry() {
  const auto answer = client_->get("odometry");
  if (!answer) return tl::unexpected<Error>(answer.error());
  const auto numbers = parse_json_numbers(*answer, 7);
  if (!numbers) return fail(numbers.error().code, "odometry: " + numbers.error().message);
  const std::vector<double>& n = *numbers;
  constexpr double kMaxAngle = 1e8;  // rad, within the domain of wrap_angle
  if (std::abs(n[2]) > kMaxAngle) {
    return fail(Errc::kProtocol, fmt::format("odometry: a heading of {} rad", n[2]));
  }
  return Odometry{{n[0], n[1], math::wrap_angle(n[2])}, {n[3], n[4], n[5]}, n[6]};
}

Result<std::vector<double>> RobotinoRest::distances() {
  const auto answer = client_->get("distancesensorarray");
  if (!answer) return tl::unexpected<Error>(answer.error());
  auto numbers = parse_json_numbers(*answer, kSensors);
  if (!numbers) {
    return fail(numbers.error().code, "distancesensorarray: " + numbers.error().message);
  }
  return numbers;
}

}  // namespace hal::robot::drivers
