#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <thread>

#include "hal/api/controller.h"

/// A robot's controller that goes wrong at given times, for the end-to-end tests.
class Faulty : public hal::Controller {
 public:
  Faulty(hal::Robot& robot, const hal::Parameters& parameters)
      : robot_(robot), parameters_(parameters) {}

  void step() override {
    if (is_due("throw_at")) throw std::runtime_error("the wheels have come off");
    if (is_due("hang_at")) std::this_thread::sleep_for(std::chrono::hours(1));
    if (is_due("nap_at")) {
      std::this_thread::sleep_for(std::chrono::milliseconds(250));
      robot_.state("awake");
    }
    while (is_due("spin_at")) count_ = count_ + 1;
    if (is_due("exit_at")) std::exit(0);
    if (is_due("leave_at")) ::_exit(0);
    if (is_due("quick_exit_at")) std::quick_exit(0);
    if (is_due("thread_exit_at")) {
      std::thread([] { std::exit(0); }).join();
    }
    fall();
    if (is_due("shout_at")) {
      robot_.log(hal::log::Level::kWarning, "\033[2Jshouted\n[   0.000000000] error r1: forged");
      robot_.state("\033]0;LOUD\007");
    }
    if (is_due("throw_loudly_at")) throw std::runtime_error("\033[2Jthe wheels are green");
    if (hal::to_seconds(robot_.now()) >= parameters_["nan_from"]) {
      const auto refused = robot_.set_body_velocity({.omega = std::nan("")});
      if (!refused) robot_.log(hal::log::Level::kWarning, refused.error().message);
    }
    if (is_due("nan_at")) {
      const auto refused =
          robot_.set_body_velocity({.vx = std::numeric_limits<double>::quiet_NaN()});
      robot_.state(refused ? "ACCEPTED" : refused.error().message);
    }
    if (is_due("beyond_at")) {
      const double speeds[] = {0, 1000, 0};
      const auto refused = robot_.set_wheel_speeds(speeds);
      robot_.state(refused ? "ACCEPTED" : refused.error().message);
    }
  }

 private:
  /// What a signal ends.
  void fall() {
    if (is_due("null_at")) *nowhere_ = 1;
    if (is_due("abort_at")) std::abort();
    if (is_due("overflow_at")) overflow(1);
    if (is_due("raise_at")) std::raise(static_cast<int>(parameters_["signal"]));
    if (is_due("thread_throw_at")) {
      std::thread([] { throw std::runtime_error("\033[2Jthe antenna has come off"); }).join();
    }
    if (is_due("thread_null_at")) {
      std::thread([this] { *nowhere_ = 1; }).join();
    }
  }

  static int overflow(int depth) {
    std::array<volatile int, 1024> much{};
    much[0] = depth;
    return depth == 0 ? 0 : overflow(depth + 1) + much[0];
  }

  /// Whether the time of a fault falls into this control cycle.
  bool is_due(const char* fault) const {
    const double now = hal::to_seconds(robot_.now());
    const double at = parameters_[fault];
    return now >= at && now - hal::to_seconds(robot_.control_period()) < at;
  }

  hal::Robot& robot_;
  const hal::Parameters parameters_;
  volatile int* volatile nowhere_ = nullptr;
  volatile unsigned count_ = 0;
};

BARAKA_CONTROLLER {
  const double never = std::numeric_limits<double>::infinity();
  return {.name = "faulty",
          .wants = {},
          .parameters = {{"throw_at", "s", never, 0, never, "Throws."},
                         {"hang_at", "s", never, 0, never, "Does not return."},
                         {"nap_at", "s", never, 0, never, "Sleeps for 0.25 s, says so."},
                         {"spin_at", "s", never, 0, never, "Computes without end."},
                         {"exit_at", "s", never, 0, never, "Calls exit(0)."},
                         {"leave_at", "s", never, 0, never, "Calls _exit(0)."},
                         {"quick_exit_at", "s", never, 0, never, "Calls quick_exit(0)."},
                         {"thread_exit_at", "s", never, 0, never, "The same on another thread."},
                         {"null_at", "s", never, 0, never, "Writes to a null pointer."},
                         {"abort_at", "s", never, 0, never, "Calls abort()."},
                         {"overflow_at", "s", never, 0, never, "Calls itself without end."},
                         {"raise_at", "s", never, 0, never, "Raises `signal`."},
                         {"signal", "1", 10, 1, 64, "Its number."},
                         {"thread_throw_at", "s", never, 0, never, "Throws on another thread."},
                         {"thread_null_at", "s", never, 0, never, "As null_at on another thread."},
                         {"shout_at", "s", never, 0, never, "Says escape sequences."},
                         {"throw_loudly_at", "s", never, 0, never, "Throws an escape sequence."},
                         {"nan_from", "s", never, 0, never, "Drives with NaN in every cycle."},
                         {"nan_at", "s", never, 0, never, "Drives with NaN."},
                         {"beyond_at", "s", never, 0, never, "Turns a wheel too fast."}},
          .make_for_robot = hal::make_for_robot<Faulty>};
}
