// SPDX-License-Identifier: Apache-2.0
/// \file sdo_client_fixture.hpp
/// A node with SDO clients; the test simulates their servers:
///
///     SdoClient node;                            // client 0 asks node-ID 5 at 605h/585h, 1 asks 6, 2 asks 7
///     node.start_upload(0x2000, 5, 8);           // COCSdoRequestUpload() into a buffer of 8 bytes
///     node.tx("605#4000200500000000");
///     node.rx("585#4F00200511000000");
///     node.has_read({0x11});                     // the callback was called once, with code 0
///
/// Guard bytes around the buffers detect wrong accesses. The buffers are released after the callback. Parameter \a
/// client: number of the client, 0 to 2; \a size is in bytes.
#pragma once

#include "fixture.hpp"

#if USE_CSDO

namespace test {

/// Variables of 1280h + n: COB-IDs of requests (tx) and responses (rx), node-ID of the server.
struct ClientEntries {
  struct Entry {
    std::uint32_t tx;
    std::uint32_t rx;
    std::uint8_t node_id;
  };
  Entry entry[3] = {{0x605, 0x585, 5}, {0x606, 0x586, 6}, {0x607, 0x587, 7}};
};

/// Returns entries whose first client uses the SDO server of the same node.
inline ClientEntries local_entries() { return {{{0x601, 0x581, 1}, {0x606, 0x586, 6}, {0x607, 0x587, 7}}}; }

/// Returns the bytes 1, 2, 3, … (modulo 256) from \a first on.
Bytes counted(std::size_t size, unsigned first = 1);

/// Arguments of a callback at the end of a transfer, and values of the client at that time.
struct ClientEnd {
  unsigned client;
  std::uint16_t index;
  std::uint8_t sub;
  std::uint32_t code;
  std::uint32_t num;    ///< COCSdoGetNum(): bytes transferred
  std::uint32_t total;  ///< COCSdoGetTotal(): bytes announced by the server
  Bytes data;           ///< the first num bytes of the buffer
};

class SdoClient : public ClientEntries, public Fixture {
 public:
  explicit SdoClient(Setup setup = Setup().only_small(), const ClientEntries& entries = {});
  ~SdoClient();

  /// Start requests that may be refused, also within a callback. Times in ms.
  CO_ERR try_upload(std::uint16_t index, std::uint8_t sub, std::uint32_t size, std::uint32_t timeout = 1000,
                    unsigned client = 0, Where at = {__builtin_FILE(), __builtin_LINE()});
  CO_ERR try_download(std::uint16_t index, std::uint8_t sub, const Bytes& data, std::uint32_t timeout = 1000,
                      unsigned client = 0, Where at = {__builtin_FILE(), __builtin_LINE()});
  /// Start requests that must be accepted.
  void start_upload(std::uint16_t index, std::uint8_t sub, std::uint32_t size, std::uint32_t timeout = 1000,
                    unsigned client = 0, Where at = {__builtin_FILE(), __builtin_LINE()});
  void start_download(std::uint16_t index, std::uint8_t sub, const Bytes& data, std::uint32_t timeout = 1000,
                      unsigned client = 0, Where at = {__builtin_FILE(), __builtin_LINE()});
  CO_ERR cancel(unsigned client = 0, Where at = {__builtin_FILE(), __builtin_LINE()});

  /// Checks that the transfer goes on: no callback was called, and the client is busy.
  void goes_on(unsigned client = 0, Where at = {__builtin_FILE(), __builtin_LINE()});
  /// Checks that one callback was called since the last check, with \a code, and the client is idle.
  ClientEnd ended(std::uint32_t code, unsigned client = 0, Where at = {__builtin_FILE(), __builtin_LINE()});
  /// Checks an upload that has succeeded with these bytes.
  ClientEnd has_read(const Bytes& data, unsigned client = 0, Where at = {__builtin_FILE(), __builtin_LINE()});
  /// Checks a download that has succeeded.
  ClientEnd has_written(unsigned client = 0, Where at = {__builtin_FILE(), __builtin_LINE()});

  CO_CSDO* csdo(unsigned client = 0) { return &node.CSdo[client]; }
  /// Return COCSdoGetNum(), the bytes transferred, and COCSdoGetTotal(), the bytes that the server has announced.
  std::uint32_t num(unsigned client = 0) const { return COCSdoGetNum(&node.CSdo[client]); }
  std::uint32_t total(unsigned client = 0) const { return COCSdoGetTotal(&node.CSdo[client]); }
  bool is_busy(unsigned client = 0) const { return node.CSdo[client].State == CO_CSDO_STATE_BUSY; }
  bool is_watched(unsigned client = 0) const;  ///< returns true if the client's timer is armed

  /// Called in each callback, after its data are stored.
  std::function<void(const ClientEnd&)> on_end;
  /// Callbacks that the test has not yet checked.
  std::deque<ClientEnd> ends;

 private:
  struct Request {
    bool open = false;
    std::uint32_t key = 0;
    Bytes memory;  ///< guard, buffer, guard
    Bytes sent;    ///< data of a download: must not change
  };
  Setup with_entries(Setup setup);
  static void on_callback(CO_CSDO* csdo, std::uint16_t index, std::uint8_t sub, std::uint32_t code);
  void store_end(unsigned client, std::uint16_t index, std::uint8_t sub, std::uint32_t code);
  void run(const std::function<void()>& api, Where at);
  CO_ERR begin(Request request, unsigned client, const std::function<CO_ERR(std::uint8_t*)>& api, Where at);
  void check_memory_of(const Request& request);
  void finish();

  Request requests_[CO_CSDO_N];
  unsigned in_callback_ = 0;
};

/// Checks that client 0 transmits requests, by an upload of 2001h.
inline void check_asks(SdoClient& node) {
  node.start_upload(0x2001, 0, 4);
  node.tx("605#4001200000000000");
  node.rx("585#4F01200011000000");
  node.has_read({0x11});
}

/// Checks that client 0 uses these COB-IDs, by an upload of 2000h:05.
inline void check_asks(SdoClient& node, const std::string& tx, const std::string& rx) {
  node.start_upload(0x2000, 5, 4);
  node.tx(tx + "#4000200500000000");
  node.rx(rx + "#4F00200511000000");
  node.has_read({0x11});
}

}  // namespace test

#endif
