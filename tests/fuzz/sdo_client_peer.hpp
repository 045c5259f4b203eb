// SPDX-License-Identifier: Apache-2.0
/// \file sdo_client_peer.hpp
/// State of one SDO client of the fuzz target sdo_client: its request, its model, and its server on an unreliable bus.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "co_core.h"
#include "support/sdo_client_model.hpp"
#include "support/sdo_server_model.hpp"

namespace fuzz {

using test::Bytes;
using test::SdoBytes;
using test::SdoClientModel;
using test::SdoKey;
using test::SdoObject;
using test::SdoServerModel;

inline std::uint32_t dev_of(const SdoKey& key) { return CO_DEV(key[0] | (key[1] << 8), key[2]); }

/// Returns data without repetition, so that bytes at wrong positions are detected.
inline Bytes pattern(std::size_t size, std::uint8_t seed) {
  Bytes bytes(size);
  for (std::size_t n = 0; n < size; ++n) {
    bytes[n] = static_cast<std::uint8_t>(seed + n + (n >> 8) * 31 + n / 7 * 3);
  }
  return bytes;
}

using Frames = std::deque<SdoBytes>;

/// A request of the application. Its buffer is released in the callback, as the stack may not use it afterwards.
struct Request {
  bool is_open = false;
  bool is_upload = false;
  SdoKey key{};
  std::uint32_t timeout = 0;
  std::unique_ptr<std::uint8_t[]> buffer;  ///< has exactly the size of the data, for the address sanitizer
  Bytes data;                              ///< data of a download

  bool keeps_data() const { return std::equal(data.begin(), data.end(), buffer.get()); }
};

/// The server of another node; the queues hold the frames that are on the bus.
struct Peer {
  explicit Peer(unsigned buffer) : server(objects(), buffer) {}

  static std::vector<SdoObject> objects() {
    using Kind = SdoObject::Kind;
    return {
        {0x2000, 0, true, true, Kind::number, 1, pattern(1, 1)},
        {0x2000, 1, true, true, Kind::number, 4, pattern(4, 2)},
        {0x2000, 2, true, true, Kind::number, 8, pattern(8, 3)},
        {0x2001, 0, true, true, Kind::octets, 28, pattern(28, 4)},
        {0x2001, 1, true, true, Kind::octets, 29, pattern(29, 5)},
        {0x2001, 2, true, true, Kind::octets, 60, pattern(60, 6)},
        {0x2001, 3, true, true, Kind::octets, 1000, pattern(1000, 7)},
        {0x2001, 4, true, true, Kind::octets, 10, {}},
    };
  }

  /// Returns true if the transferred data equal the value of the object.
  bool has_right_data() const {
    const Bytes& right = request.is_upload ? model.data() : request.data;
    return std::any_of(server.objects().begin(), server.objects().end(), [&](const SdoObject& object) {
      return CO_DEV(object.index, object.sub) == dev_of(request.key) && object.value == right;
    });
  }

  Request request;
  SdoClientModel model{CO_CSDO_BLOCK};
  SdoServerModel server;
  Frames waiting{};  ///< requests that the controller has not accepted yet
  Frames to_server{};
  Frames to_client{};
  bool is_configured = true;
  bool is_tampered = false;  ///< in this transfer the client received a frame that its server had not sent for it
};

}  // namespace fuzz
