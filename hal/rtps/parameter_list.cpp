#include "hal/rtps/parameter_list.h"

namespace hal::rtps {

const Parameter* ParameterList::next() {
  current_.id = cursor_.u16();
  const std::uint16_t length = cursor_.u16();
  if (cursor_.is_short()) {
    objection_ = "a list of parameters has no end";
    return nullptr;
  }
  if (current_.id == parameter::kSentinel) return nullptr;  // its length has no meaning
  if (length % 4 != 0) {
    objection_ = "the length of a parameter is no multiple of 4";
    return nullptr;
  }
  current_.value = cursor_.take(length);
  if (cursor_.is_short()) {
    objection_ = "a parameter is longer than its list";
    return nullptr;
  }
  return &current_;
}

}  // namespace hal::rtps
