#include "hal/files/config/document.h"

#include <utility>

#include "hal/files/config/loader.h"
#include "hal/files/config/overrides.h"
#include "hal/files/config/problems.h"

namespace hal::files::config {

struct Document::State {
  Node root;
  Problems problems;
  std::vector<Included> included{};
};

Document::Document(std::unique_ptr<State> state) : state_(std::move(state)) {}
Document::~Document() = default;
Document::Document(Document&&) noexcept = default;

Document Document::load(const std::filesystem::path& file,
                        const std::vector<std::string>& overrides) {
  auto state = std::make_unique<State>();
  Node top = read_overrides(overrides, state->problems);
  const bool overrides_readable = state->problems.none();
  Loader loader(file, state->problems);
  state->root = merged(loader.load(file, Layer::kFile, ""), std::move(top));
  if (loader.complete()) loader.resolve(state->root, "");
  if (!overrides_readable || !loader.complete()) throw ConfigErrors(state->problems.messages());
  state->included = loader.included();
  return Document(std::move(state));
}

Mapping Document::root() { return {state_->root, "", state_->problems}; }

const std::vector<Included>& Document::included() const { return state_->included; }

void Document::finish() const {
  if (!state_->problems.none()) throw ConfigErrors(state_->problems.messages());
}

std::vector<std::string> Document::warnings() const { return state_->problems.warnings(); }

}  // namespace hal::files::config
