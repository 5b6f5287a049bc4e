#include "sim/report/cdr.h"

namespace sim::report {

void Cdr::put(std::string_view text) {
  put_count(text.size() + 1);
  bytes_ += text;
  bytes_ += '\0';
}

void Cdr::align(std::size_t size) {
  const std::size_t beyond = (bytes_.size() - kHeader) % size;
  if (beyond != 0) bytes_.append(size - beyond, '\0');
}

}  // namespace sim::report
