#include "hal/api/parameters.h"

#include "hal/types/check.h"

namespace hal {

double Parameters::operator[](std::string_view name) const {
  const auto found = values_.find(name);
  BARAKA_CHECK(found != values_.end());
  return found->second;
}

}  // namespace hal
