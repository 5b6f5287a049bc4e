#pragma once

namespace hal {

/// Whether an enumeration has exactly the values 0 .. kCount - 1. Its `name` is a switch over all
/// of them without a default and returns "" for any other value. The compiler rejects a switch that
/// omits one, so a new value cannot lack a name, nor have one without being counted:
///
///   constexpr std::string_view name(Fruit fruit) {
///     switch (fruit) {
///       case Fruit::kApple:
///         return "apple";
///     }
///     return {};
///   }
///   static_assert(hal::names_exactly<Fruit, kFruits>([](Fruit f) { return name(f); }));
template <class Enum, int kCount, class Name>
consteval bool names_exactly(Name name) {
  for (int i = 0; i < kCount; ++i) {
    if (name(static_cast<Enum>(i)).empty()) return false;
  }
  return name(static_cast<Enum>(kCount)).empty();
}

}  // namespace hal
