// SPDX-License-Identifier: Apache-2.0
/// \file sdo_client_peer.hpp
/// An SDO server with one object for tests of clients, with data too long to be typed. It checks every frame of the
/// client against the standard and stores the first fault. [301:7.2.4.3]
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sdo_client_fixture.hpp"

#if USE_CSDO

namespace test {

using Frames = std::vector<CO_IF_FRM>;

/// Returns the CRC-16-CCITT of block transfers, computed bit by bit. [D14]
std::uint16_t crc_of(const Bytes& data);

struct PeerOptions {
  bool crc = true;
  bool announces = true;
  std::vector<std::uint8_t> block_sizes = {127};  ///< blksizes of downloads, one per block, repeated
};

/// The server of 2000h:05 at 605h/585h.
class SdoPeer {
 public:
  explicit SdoPeer(Bytes data, PeerOptions options = {});

  Frames answers_to(const CO_IF_FRM& request);
  /// Returns the frames sent after a time without frames: the last acknowledge once more.
  Frames after_silence();

  Bytes object;
  std::string fault;  ///< first fault of the client; empty: none
  bool is_done = false;
  std::uint32_t abort = 0;  ///< code of the client's abort

 private:
  enum class State { idle, upload, sub_block, upload_end, download, download_end };
  Frames initiate(const CO_IF_FRM& request);
  Frames initiate_upload(const CO_IF_FRM& request);
  Frames initiate_download(const CO_IF_FRM& request);
  Frames acknowledged(const CO_IF_FRM& request);
  Frames next_sub_block();
  Frames segment_received(const CO_IF_FRM& request);
  Frames end_received(const CO_IF_FRM& request);
  CO_IF_FRM acknowledge();
  void expect(bool right, const char* what);

  PeerOptions options_;
  State state_ = State::idle;
  std::uint8_t block_size_ = 0;
  std::size_t blocks_ = 0;
  std::size_t position_ = 0;  ///< acknowledged bytes of an upload
  unsigned sent_ = 0;         ///< sent segments of the sub-block
  unsigned received_ = 0;
  bool last_ = false;
  std::uint32_t announced_ = 0;
  Frames repeat_;
};

/// Fault of the bus for one frame of one direction. Frames are numbered from 0.
struct Disturbance {
  enum class Kind { none, lose, repeat, swap_with_next, change_bit };
  Kind kind = Kind::none;
  std::size_t at = 0;
  bool to_node = true;
};

/// Runs the transfer of client 0 with \a peer to its end. Returns false if it has not ended.
bool serve(SdoClient& node, SdoPeer& peer, const Disturbance& disturbance = {});

}  // namespace test

#endif
