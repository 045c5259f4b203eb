// SPDX-License-Identifier: Apache-2.0
/// \file compress.hpp
/// Compression of generated data.
#pragma once

#include <string>
#include <string_view>

namespace lexican::codict {

/// Returns the bytes as a zlib stream (RFC 1950), compressed as far as possible.
std::string zlib_compressed(std::string_view bytes);

}  // namespace lexican::codict
