#include "hal/rtps/entity_id.h"

#include <algorithm>

namespace hal::rtps {
namespace {

struct Named {
  std::uint32_t value;
  std::string_view name;
};

constexpr Named kNamed[] = {
    {0x00000000, "unknown"},
    {0x000001c1, "participant"},
    {0x000002c2, "SEDP topic writer"},
    {0x000002c7, "SEDP topic reader"},
    {0x000003c2, "SEDP publication writer"},
    {0x000003c7, "SEDP publication reader"},
    {0x000004c2, "SEDP subscription writer"},
    {0x000004c7, "SEDP subscription reader"},
    {0x000100c2, "SPDP writer"},
    {0x000100c7, "SPDP reader"},
    {0x000200c2, "participant message writer"},
    {0x000200c7, "participant message reader"},
    {0x000300c3, "type lookup request writer"},
    {0x000300c4, "type lookup request reader"},
    {0x000301c3, "type lookup reply writer"},
    {0x000301c4, "type lookup reply reader"},
    {0x000201c3, "authentication writer"},
    {0x000201c4, "authentication reader"},
    {0xff0003c2, "secure SEDP publication writer"},
    {0xff0003c7, "secure SEDP publication reader"},
    {0xff0004c2, "secure SEDP subscription writer"},
    {0xff0004c7, "secure SEDP subscription reader"},
    {0xff0101c2, "secure SPDP writer"},
    {0xff0101c7, "secure SPDP reader"},
    {0xff0200c2, "secure participant message writer"},
    {0xff0200c7, "secure participant message reader"},
    {0xff0202c3, "key exchange writer"},
    {0xff0202c4, "key exchange reader"},
};

}  // namespace

std::string_view name_of(EntityId entity) {
  const auto* const named = std::ranges::find(kNamed, entity.value, &Named::value);
  if (named != std::end(kNamed)) return named->name;
  if (entity.is_writer()) return entity.is_builtin() ? "builtin writer" : "user writer";
  if (entity.is_reader()) return entity.is_builtin() ? "builtin reader" : "user reader";
  return "entity of an unknown kind";
}

}  // namespace hal::rtps
