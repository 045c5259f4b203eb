// SPDX-License-Identifier: Apache-2.0
/// \file logged_extension.hpp
/// Extensions of objects (co_od.h) that keep bytes of their own and write down how they are called: "read 7 at 0 of 9",
/// "write 2 at 7 of 9"; of 0: the length is not known.
///
///     LoggedExtension extension;
///     extension.put_at(node, 0x3000);            // OD_extension_init() has said ODR_OK
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

/// The bytes of a number, the lowest first as on the bus, in the order of the CPU; and back.
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
  Bytes data;                   ///< what is read, and what was written, once it is complete
  Bytes arrived;                ///< pieces of what is being written
  std::uint32_t at_once = ~0U;  ///< bytes that a read gives at most: the contract would have all that fit
  ODR_t answer = ODR_OK;        ///< anything else: every call is refused
  /// Called before anything else; what they return, unless it is ODR_OK, is the answer.
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
