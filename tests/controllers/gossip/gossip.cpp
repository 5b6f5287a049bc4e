#include <fmt/format.h>

#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "hal/api/controller.h"

/// Says its words, one after the other, at the times it is given, and records what it knows, for
/// the end-to-end tests: addresses of names, how far its first friend is, whom it hears. Robots
/// drive.
template <class Body>
class Gossip : public hal::Controller {
 public:
  Gossip(Body& body, const hal::Parameters& parameters)
      : body_(body),
        friends_(parameters.texts("friends")),
        words_(parameters.texts("words")),
        times_(parameters.numbers("times")),
        to_(parameters.flag("floods") ? hal::kEveryone : hal::kNeighbours),
        topic_(parameters.text("topic")) {}

  void start() override {
    for (const std::string& name : friends_) {
      const auto address = body_.address_of(name);
      body_.record("address of " + name, address ? address->value : -1);
    }
    for (std::size_t i = 0; i < times_.size(); ++i) {
      (void)body_.set_timer(static_cast<hal::TimerId>(i), hal::Time{hal::from_seconds(times_[i])});
    }
    if constexpr (std::is_base_of_v<hal::Robot, Body>) {
      (void)body_.set_body_velocity({.vx = 0.3, .omega = 0.2});
    }
  }

  void step() override {
    if (friends_.empty()) return;
    const auto nearest = body_.address_of(friends_.front());
    if (!nearest) return;
    const auto place = body_.relative_position(*nearest);
    if (place) body_.record("distance", std::sqrt(place->x * place->x + place->y * place->y));
  }

  void timer(hal::TimerId id) override {
    const std::string& word = words_.at(id % words_.size());
    const auto sent =
        body_.send(to_, topic_, {reinterpret_cast<const std::uint8_t*>(word.data()), word.size()});
    if (!sent) body_.state("NOT_SENT");
  }

  void receive(const hal::Message& message) override {
    const std::string word(message.payload.begin(), message.payload.end());
    body_.state(fmt::format("{} says {}: {}", body_.name_of(message.source).value_or("nobody"),
                            message.topic, word));
  }

  void notice(hal::MessageId id, hal::Fate fate) override {
    body_.record(fmt::format("{} {}", topic_, hal::to_string(fate)), id);
  }

 private:
  Body& body_;
  const std::vector<std::string> friends_, words_;
  const std::vector<double> times_;
  const hal::AgentId to_;
  const std::string topic_;
};

BARAKA_CONTROLLER {
  using Texts = std::vector<std::string>;
  return {.name = "gossip",
          .wants = {.optional = {"localisation"}, .names = true},
          .parameters = {{.name = "friends", .default_value = Texts{}, .meaning = "Names."},
                         {.name = "words", .default_value = Texts{"hello"}, .meaning = "Said."},
                         {.name = "times",
                          .unit = "s",
                          .default_value = std::vector<double>{},
                          .low = 0,
                          .high = 1e3,
                          .meaning = "When it speaks."},
                         {.name = "floods",
                          .default_value = false,
                          .meaning = "Whether it speaks to everyone, or to neighbours."},
                         {.name = "topic",
                          .default_value = "gossip",
                          .meaning = "Of what it says.",
                          .choices = {"gossip", "news"}}},
          .make_for_mote = hal::make_for_mote<Gossip<hal::Mote>>,
          .make_for_robot = hal::make_for_robot<Gossip<hal::Robot>>};
}
