#pragma once

#include <string>
#include <string_view>

namespace results::record {

/// Converts the name of a DDS topic to a part of the name of a number. Letters, digits, '_', '-'
/// and
/// '/' stay as they are; of everything else, each octet becomes '%' and two hexadecimal digits, as
/// in a URI (RFC 3986, 2.1). "rt/r0/scan" stays "rt/r0/scan", "a.b" becomes "a%2Eb". Different
/// topics have different parts, which contain no dots.
std::string topic_part(std::string_view topic);

/// The topic of such a part.
std::string topic_of_part(std::string_view part);

}  // namespace results::record
