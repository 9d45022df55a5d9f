#pragma once
/// \file
/// Percent-encoding of references to features and files (RFC 3986).

#include <string>
#include <string_view>

namespace svt::readers::gml {

/// Decodes "a%20b" to "a b"; invalid encodings are kept.
[[nodiscard]] std::string percentDecoded(std::string_view text);

}  // namespace svt::readers::gml
