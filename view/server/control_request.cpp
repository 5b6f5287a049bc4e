#include "view/server/control_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

namespace view::server {
namespace {

using hal::Errc;
using nlohmann::json;

constexpr std::int64_t kMostSteps = 1'000'000;
constexpr double kMostSpeed = 1e9, kMostDrive = 1e3;
constexpr std::size_t kLongestName = 200;

template <class Value>
struct Named {
  std::string_view name;
  Value value;
};

/// The members of a command; each is read once. The first mistake is kept as the message.
class Members {
 public:
  explicit Members(const json& body) : body_(body) {}

  std::optional<std::string> text(const char* key) {
    const json* value = find(key);
    if (value == nullptr) return std::nullopt;
    if (value->is_string() && value->get_ref<const std::string&>().size() <= kLongestName) {
      return value->get<std::string>();
    }
    return wrong(key, fmt::format("a text of at most {} bytes", kLongestName)), std::nullopt;
  }

  std::optional<std::int64_t> integer(const char* key, std::int64_t least, std::int64_t most) {
    const json* value = find(key);
    if (value == nullptr) return std::nullopt;
    if (value->is_number_integer() && !is_too_large(*value)) {
      const auto number = value->get<std::int64_t>();
      if (number >= least && number <= most) return number;
    }
    return wrong(key, fmt::format("a whole number from {} to {}", least, most)), std::nullopt;
  }

  std::optional<double> number(const char* key, double least, double most) {
    const json* value = find(key);
    if (value == nullptr) return std::nullopt;
    if (value->is_number()) {
      const double number = value->get<double>();
      if (number >= least && number <= most) return number;
    }
    return wrong(key, fmt::format("a number from {} to {}", least, most)), std::nullopt;
  }

  std::optional<std::uint16_t> agent() {
    const auto address = integer("agent", 1, 0xfffd);
    if (!address) return std::nullopt;
    return static_cast<std::uint16_t>(*address);
  }

  template <class Value>
  Value needed(const char* key, const std::optional<Value>& value) {
    if (!value && mistake_.empty()) mistake_ = fmt::format("{}: is missing", key);
    return value.value_or(Value{});
  }

  /// The value that a member names. The first value if the name is wrong, which is noted.
  template <class Value, std::size_t kCount>
  Value one_of(const char* key, const std::array<Named<Value>, kCount>& all) {
    const std::string name = needed(key, text(key));
    if (!mistake_.empty()) return all.front().value;
    const auto* const found = std::ranges::find(all, name, &Named<Value>::name);
    if (found != all.end()) return found->value;
    std::string allowed;
    for (const Named<Value>& one : all) {
      allowed += allowed.empty() ? std::string(one.name) : fmt::format(", {}", one.name);
    }
    wrong(key, "one of " + allowed);
    return all.front().value;
  }

  const std::string& mistake() const { return mistake_; }

 private:
  const json* find(const char* key) const {
    const auto found = body_.find(key);
    return found == body_.end() || found->is_null() ? nullptr : &*found;
  }
  static bool is_too_large(const json& value) {
    return value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX;
  }
  void wrong(const char* key, const std::string& allowed) {
    if (!mistake_.empty()) return;
    const std::string seen = body_.at(key).dump(-1, ' ', true, json::error_handler_t::replace);
    mistake_ = fmt::format("{}: {} is not {}", key, seen.substr(0, kLongestName), allowed);
  }

  const json& body_;
  std::string mistake_;
};

Command steps(Members& in) {
  using Of = Steps::Of;
  constexpr std::array kOf = {Named<Of>{"cycle", Of::kCycle}, Named<Of>{"frame", Of::kFrame},
                              Named<Of>{"event", Of::kEvent}};
  Steps steps;
  steps.of = in.one_of("of", kOf);
  steps.count = in.integer("count", 1, kMostSteps).value_or(1);
  steps.agent = in.agent();
  return steps;
}

Command break_on(Members& in) {
  using On = Break::On;
  constexpr std::array kOn = {
      Named<On>{"state", On::kState},     Named<On>{"message", On::kMessage},
      Named<On>{"loss", On::kLoss},       Named<On>{"collision", On::kCollision},
      Named<On>{"contact", On::kContact}, Named<On>{"time", On::kTime}};
  Break made;
  made.on = in.one_of("on", kOn);
  made.agent = in.agent();
  made.state = in.text("state").value_or("");
  made.topic = in.text("topic").value_or("");
  const auto at = in.integer("at", 0, INT64_MAX);
  made.at = made.on == Break::On::kTime ? in.needed("at", at) : at.value_or(0);
  return made;
}

Command drive(Members& in) {
  DriveByHand made;
  made.agent = in.needed("agent", in.agent());
  made.vx = in.needed("vx", in.number("vx", -kMostDrive, kMostDrive));
  made.vy = in.number("vy", -kMostDrive, kMostDrive).value_or(0);
  made.omega = in.needed("omega", in.number("omega", -kMostDrive, kMostDrive));
  return made;
}

Command speed(Members& in) {
  return Speed{in.needed("factor", in.number("factor", 0, kMostSpeed))};
}

Command clear(Members& in) { return Clear{in.needed("id", in.integer("id", 0, INT64_MAX))}; }

Command read(Members& in) {
  using Read = Command (*)(Members&);
  constexpr std::array kCommands = {
      Named<Read>{"pause", [](Members&) -> Command { return Pause{}; }},
      Named<Read>{"resume", [](Members&) -> Command { return Resume{}; }},
      Named<Read>{"step", steps},
      Named<Read>{"speed", speed},
      Named<Read>{"break", break_on},
      Named<Read>{"clear", clear},
      Named<Read>{"drive", drive}};
  return in.one_of("command", kCommands)(in);
}

}  // namespace

hal::Result<Command> command_in(std::string_view body) {
  const json parsed = json::parse(body, nullptr, false);
  if (!parsed.is_object()) return hal::fail(Errc::kInvalidArgument, "a command is a JSON object");
  Members in(parsed);
  Command command = read(in);
  if (!in.mistake().empty()) return hal::fail(Errc::kInvalidArgument, in.mistake());
  return command;
}

}  // namespace view::server
