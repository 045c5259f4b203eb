// SPDX-License-Identifier: Apache-2.0
/// \file sdo_client.hpp
/// SDO transfers of the master, expedited and segmented. [301:7.2.4.3.3…7.2.4.3.7]
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "linux_node/master.hpp"

namespace demo {

using Bytes = std::vector<std::uint8_t>;

/// How a transfer ended.
struct Transfer {
  Bytes data;                    // upload: what was read
  std::uint32_t abort_code = 0;  // of the server
  std::string fault;             // else: what went wrong; empty: nothing

  bool done() const { return abort_code == 0 && fault.empty(); }
  /// The end in words.
  std::string outcome() const;
};

class SdoClient {
 public:
  /// Talks to the node of \a master; an answer has to come within \a timeout.
  explicit SdoClient(Master& master, Micros timeout = second) : master_(master), timeout_(timeout) {}

  Transfer upload(std::uint16_t index, std::uint8_t sub);
  /// \a data: up to 4 bytes go expedited, more in segments; must not be empty.
  Transfer download(std::uint16_t index, std::uint8_t sub, const Bytes& data);

 private:
  using Payload = std::uint8_t[8];
  struct Object {
    std::uint16_t index;
    std::uint8_t sub;
  };

  bool ask(const Payload& request, CO_IF_FRM& response, Transfer& transfer);
  bool begin(std::uint8_t command, Object object, const std::uint8_t* data, std::size_t size, CO_IF_FRM& response,
             Transfer& transfer);
  void upload_segments(Transfer& transfer);
  void download_segments(const Bytes& data, Transfer& transfer);
  void abort(std::uint32_t code, const char* fault, Transfer& transfer);

  Master& master_;
  Micros timeout_;
  Object object_{};
};

}  // namespace demo
