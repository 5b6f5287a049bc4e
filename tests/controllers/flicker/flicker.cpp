#include "hal/api/controller.h"

/// Broadcasts a long message at each control instant, 9 ms on the air at 1 Mb/s, and switches its
/// radio off 4 ms later, until 10 ms before the next: for the end-to-end tests. Of every third
/// message the radio stays on.
class Flicker : public hal::Controller {
 public:
  Flicker(hal::Mote& mote, const hal::Parameters&) : self_(mote) {}

  void step() override {
    (void)self_.send(hal::kNeighbours, "flicker", hal::Bytes(1000));
    if (++steps_ % 3 == 0) return;
    (void)self_.set_timer(kOff, self_.now() + std::chrono::milliseconds{4});
    (void)self_.set_timer(kOn, self_.now() + std::chrono::milliseconds{40});
  }

  void timer(hal::TimerId id) override { self_.set_radio(id == kOn); }

 private:
  static constexpr hal::TimerId kOff = 1;
  static constexpr hal::TimerId kOn = 2;

  hal::Mote& self_;
  int steps_ = 0;
};

BARAKA_CONTROLLER { return {.name = "flicker", .make_for_mote = hal::make_for_mote<Flicker>}; }
