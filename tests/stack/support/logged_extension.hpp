// SPDX-License-Identifier: Apache-2.0
/// \file logged_extension.hpp
/// Object extensions (co_od.h) that store bytes and log their calls: "read 7 at 0 of 9", "write 2 at 7 of 9" (bytes,
/// offset, length; length 0: unknown).
///
///     LoggedExtension extension;
///     extension.put_at(node, 0x3000);            // calls OD_extension_init(), which must return ODR_OK
///     extension.data = {1, 2, 3};
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "fixture.hpp"

#if USE_OD

namespace test {

using Log = std::vector<std::string>;

/// Converts the bytes of a number from the byte order of the bus (lowest first) to that of the CPU, or back.
inline Bytes number_of(Bytes bytes) {
  if constexpr (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__) {
    std::reverse(bytes.begin(), bytes.end());
  }
  return bytes;
}

class LoggedExtension {
 public:
  LoggedExtension() {
    extension.object = this;
    extension.read = read;
    extension.write = write;
  }
  LoggedExtension(const LoggedExtension&) = delete;
  LoggedExtension& operator=(const LoggedExtension&) = delete;

  void put_at(Fixture& node, std::uint16_t index) {
    node.call([&] { CHECK(OD_extension_init(OD_find(&node.od, index), &extension) == ODR_OK); });
  }

  Log take_log() {
    Log taken;
    taken.swap(log);
    return taken;
  }

  OD_extension_t extension{};
  Log log;
  Bytes data;                   ///< value that is read; replaced when a write is complete
  Bytes arrived;                ///< bytes of an incomplete write
  std::uint32_t at_once = ~0U;  ///< limit of the bytes that a read returns; the contract requires as many as fit
  ODR_t answer = ODR_OK;        ///< result of all calls, unless it is ODR_OK
  /// Called first in each read or write. A result other than ODR_OK is returned to the caller.
  std::function<ODR_t(OD_stream_t*)> on_read;
  std::function<ODR_t(OD_stream_t*)> on_write;

 private:
  void note(const char* what, const OD_stream_t& stream, OD_size_t count) {
    log.push_back(std::string(what) + " " + std::to_string(count) + " at " + std::to_string(stream.dataOffset) +
                  " of " + std::to_string(stream.dataLength));
  }

  ODR_t verdict(const std::function<ODR_t(OD_stream_t*)>& function, OD_stream_t* stream) const {
    const ODR_t own = function ? function(stream) : ODR_OK;
    return own != ODR_OK ? own : answer;
  }

  static ODR_t read(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* passed) {
    const OutsideStack outside;
    auto& self = *static_cast<LoggedExtension*>(stream->object);
    self.note("read", *stream, count);
    const ODR_t verdict = self.verdict(self.on_read, stream);
    if (verdict != ODR_OK) {
      return verdict;
    }
    const auto size = static_cast<OD_size_t>(self.data.size());
    const OD_size_t left = size - std::min(size, stream->dataOffset);
    *passed = std::min({left, count, self.at_once});
    std::copy_n(self.data.data() + (size - left), *passed, static_cast<std::uint8_t*>(buf));
    const bool last = *passed == left;
    stream->dataOffset = last ? 0 : stream->dataOffset + *passed;
    return last ? ODR_OK : ODR_PARTIAL;
  }

  static ODR_t write(OD_stream_t* stream, const void* buf, OD_size_t count, OD_size_t* passed) {
    const OutsideStack outside;
    auto& self = *static_cast<LoggedExtension*>(stream->object);
    self.note("write", *stream, count);
    const ODR_t verdict = self.verdict(self.on_write, stream);
    if (verdict != ODR_OK) {
      return verdict;
    }
    if (stream->dataOffset == 0) {
      self.arrived.clear();
    }
    const auto* const bytes = static_cast<const std::uint8_t*>(buf);
    self.arrived.insert(self.arrived.end(), bytes, bytes + count);
    *passed = count;
    const bool last = stream->dataOffset + count == stream->dataLength;
    stream->dataOffset = last ? 0 : stream->dataOffset + count;
    if (last) {
      self.data = self.arrived;
    }
    return last ? ODR_OK : ODR_PARTIAL;
  }
};

}  // namespace test

#endif
