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
/// Owner: the test. The model has no clock: the test calls remind() and close() when a time-out ends.
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

  /// Processes a frame of the server. Returns the client's immediate answer.
  std::optional<SdoBytes> answer(const SdoBytes& response);
  /// Sends and returns the next segment of a block download, nothing if there is none.
  std::optional<SdoBytes> segment();
  /// Returns true if the client may send this without a received frame, and changes the state accordingly.
  bool remind(const SdoBytes& request);
  /// Ends the transfer for another reason than an answer of the server.
  void close(std::uint32_t code);
  /// Returns the frame that the client sends to the server then.
  SdoBytes abort(std::uint32_t code) const;

  bool is_open() const { return state_ != State::idle; }
  std::uint32_t end() const { return end_; }   ///< abort code of the last transfer; 0: success
  const Bytes& data() const { return data_; }  ///< data of the last upload
  bool can_remind() const { return state_ == State::block_upload || state_ == State::block_upload_end; }

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
  Answer aborted(const SdoBytes& response);
  Answer answer_in_state(const SdoBytes& response);

  Answer upload_initiated(const SdoBytes& response);
  Answer take_expedited(const SdoBytes& response);
  Answer take_size(const SdoBytes& response, bool told, unsigned next);
  Answer take(const SdoBytes& response);
  Answer download_initiated(const SdoBytes& response);
  SdoBytes next_segment() const;
  Answer segment_taken(const SdoBytes& response);

  Answer take_in_block(const SdoBytes& response);
  std::uint32_t collect(const SdoBytes& response);
  SdoBytes acknowledge(bool all);
  bool is_last_again(const SdoBytes& response) const;
  bool is_right_end(const SdoBytes& response) const;
  Answer end_block_upload(const SdoBytes& response);
  Answer block_taken(const SdoBytes& response);

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
  std::size_t seq_ = 0;     // last segment of the block received in order, or sent
  std::size_t ackseq_ = 0;  // last one that was acknowledged
  bool heard_ = false;      // a segment of the block was received
  bool last_sent_ = false;
};

}  // namespace test
