#pragma once

namespace hal {

/// Lambdas as one visitor of a std::variant: std::visit(Overloaded{[](int) {}, [](double) {}}, v).
template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

}  // namespace hal
