// SPDX-License-Identifier: Apache-2.0
/// \file sdo_client_model.hpp
/// A model of an SDO client, derived from the standard and the contract of co_csdo.h, and independent of the stack.
/// [301:7.2.4.3] [C1]
///
///     SdoClientModel model(CO_CSDO_BLOCK);
///     model.start_upload({0x00, 0x20, 0x05}, 4);         // returns 40 00 20 05 00 00 00 00
///     model.answer({0x4F, 0x00, 0x20, 0x05, 0x07});      // returns nothing: the upload is complete
///     model.end();                                       // 0: success; the bytes are in model.data()
///
/// Owner: the test. The model has no clock: the test calls repeat_acknowledge() and close() when a time-out ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "sdo_server_model.hpp"

namespace test {

class SdoClientModel {
 public:
  /// \a block: smallest size in bytes that is requested as block transfer; 0: never.
  explicit SdoClientModel(std::size_t block) : block_threshold_(block) {}

  /// Start a transfer. Both return the first request.
  SdoBytes start_upload(const SdoKey& key, std::size_t size);
  SdoBytes start_download(const SdoKey& key, const Bytes& data);

  /// Processes a frame of the server. Returns the client's next request, nothing if it sends none.
  std::optional<SdoBytes> answer(const SdoBytes& response);
  /// Returns the next segment of a block download, nothing if the block is complete. The segment counts as sent.
  std::optional<SdoBytes> segment();
  /// Returns true if \a request is the acknowledge that the client may repeat while it receives no segments of a block
  /// upload, and changes the state accordingly.
  bool repeat_acknowledge(const SdoBytes& request);
  /// Ends the transfer for another reason than a response of the server. \a code: abort code.
  void close(std::uint32_t code);
  /// Returns the abort frame of the client.
  SdoBytes abort(std::uint32_t code) const;

  bool is_open() const { return state_ != State::idle; }
  std::uint32_t end() const { return end_; }   ///< abort code of the last transfer; 0: success
  const Bytes& data() const { return data_; }  ///< data of the last upload
  bool can_repeat_acknowledge() const { return state_ == State::block_upload || state_ == State::block_upload_end; }

 private:
  enum class State {
    idle,
    initiated,
    download,
    upload,
    block_download,
    block_download_end,
    block_upload,
    block_upload_end
  };
  using Answer = std::optional<SdoBytes>;

  SdoBytes initiate();
  SdoBytes head(unsigned command) const;
  Answer give_up(std::uint32_t code);
  Answer finish(std::uint32_t code);
  Answer abort_received(const SdoBytes& response);
  Answer answer_in_state(const SdoBytes& response);

  Answer upload_initiated(const SdoBytes& response);
  Answer receive_expedited(const SdoBytes& response);
  Answer receive_size(const SdoBytes& response, bool has_size, unsigned next);
  Answer receive_segment(const SdoBytes& response);
  Answer download_initiated(const SdoBytes& response);
  SdoBytes next_segment() const;
  Answer segment_confirmed(const SdoBytes& response);

  Answer receive_block_segment(const SdoBytes& response);
  std::uint32_t store_segment(const SdoBytes& response);
  SdoBytes acknowledge(bool all);
  bool repeats_last_segment(const SdoBytes& response) const;
  bool is_correct_end(const SdoBytes& response) const;
  Answer end_block_upload(const SdoBytes& response);
  Answer block_confirmed(const SdoBytes& response);

  std::size_t block_threshold_;
  State state_ = State::idle;
  std::uint32_t end_ = 0;
  SdoKey key_{};
  bool is_upload_ = false;
  bool by_block_ = false;
  bool has_crc_ = false;
  std::size_t size_ = 0;              // size of the buffer
  std::optional<std::size_t> total_;  // size that the server has announced
  Bytes data_;                        // uploaded bytes, or bytes to download
  std::size_t done_ = 0;  // bytes of a download that the server has received, or of an upload before the current block
  std::uint8_t toggle_ = 0;
  std::size_t blksize_ = 0;
  std::size_t seq_ = 0;            // last segment of the block received in order, or sent
  std::size_t ackseq_ = 0;         // last segment that was acknowledged
  bool has_segment_ = false;       // a segment of the block was received
  bool has_acknowledged_ = false;  // a block was acknowledged, even if none of its segments were received in order
  bool last_sent_ = false;
};

}  // namespace test
