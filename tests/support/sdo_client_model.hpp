// SPDX-License-Identifier: Apache-2.0
/// \file sdo_client_model.hpp
/// An SDO client beside that of the stack: it knows the protocol of the standard and what co_csdo.h promises, and
/// nothing of the stack. [301:7.2.4.3] [C1]
///
///     SdoClientModel model(CO_CSDO_BLOCK);
///     model.start_upload({0x00, 0x20, 0x05}, 4);         // asks 40 00 20 05 00 00 00 00
///     model.answer({0x4F, 0x00, 0x20, 0x05, 0x07});      // nothing more is to be asked
///     model.end();                                       // 0: done, with these bytes: model.data()
///
/// Owner: the test. When a silence ends, and with it a transfer, is the clock's to tell: remind() and close().
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "sdo_server_model.hpp"

namespace test {

class SdoClientModel {
 public:
  /// \a block: bytes from which on it asks for a block transfer; 0: never.
  explicit SdoClientModel(std::size_t block) : block_threshold_(block) {}

  /// Both return the first request.
  SdoBytes start_upload(const SdoKey& key, std::size_t size);
  SdoBytes start_download(const SdoKey& key, const Bytes& data);

  /// A frame of the server arrives. What the client answers at once.
  std::optional<SdoBytes> answer(const SdoBytes& response);
  /// The next segment of a block download, which is thereby sent. Nothing: there is none now.
  std::optional<SdoBytes> segment();
  /// Returns true if the client may send this without a received frame, and changes the state accordingly.
  bool remind(const SdoBytes& request);
  /// The transfer ends by something else than an answer of the server.
  void close(std::uint32_t code);
  /// With which frame the client then tells the server.
  SdoBytes abort(std::uint32_t code) const;

  bool is_open() const { return state_ != State::idle; }
  std::uint32_t end() const { return end_; }   ///< how the last transfer has ended, as an abort code; 0: well
  const Bytes& data() const { return data_; }  ///< of the last upload
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
  std::size_t size_ = 0;              // of the buffer
  std::optional<std::size_t> total_;  // that the server has announced
  Bytes data_;                        // uploaded, or to be downloaded
  std::size_t done_ = 0;  // bytes of a download that the server has, or of an upload before the present block
  std::uint8_t toggle_ = 0;
  std::size_t blksize_ = 0;
  std::size_t seq_ = 0;     // last segment of the block that was taken or sent
  std::size_t ackseq_ = 0;  // last one that was acknowledged
  bool heard_ = false;      // a segment of the block has come
  bool last_sent_ = false;
};

}  // namespace test
