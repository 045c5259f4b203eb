// SPDX-License-Identifier: Apache-2.0
#include "text/compress.hpp"

#include <zlib.h>

#include <new>

namespace lexican::codict {

std::string zlib_compressed(std::string_view bytes) {
  uLongf size = ::compressBound(static_cast<uLong>(bytes.size()));
  std::string compressed(size, '\0');
  // With enough space in the output, the only error is a lack of memory.
  if (::compress2(reinterpret_cast<Bytef*>(compressed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                  static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION) != Z_OK) {
    throw std::bad_alloc();
  }
  compressed.resize(size);
  return compressed;
}

}  // namespace lexican::codict
