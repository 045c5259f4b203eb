// SPDX-License-Identifier: Apache-2.0
/// \file sdo_server_model.hpp
/// A model of an SDO server, derived only from the standard and independent of the stack. Sweeps, walks and fuzz
/// targets compare the stack with it. [301:7.2.4.3]
///
///     SdoServerModel model({{0x2000, 0, true, true, SdoObject::Kind::number, 1, {7}}}, CO_SDO_BUF_SEG);
///     model.answer({0x40, 0x00, 0x20, 0x00});            // 4F 00 20 00 07 00 00 00
///
/// Owner: the test. One model is one channel with a separate dictionary.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "block.hpp"

namespace test {

using Bytes = std::vector<std::uint8_t>;
using SdoBytes = std::array<std::uint8_t, 8>;
using SdoKey = std::array<std::uint8_t, 3>;  ///< multiplexer in the byte order of a frame

/// An object as seen from the network.
struct SdoObject {
  enum class Kind { number, boolean, domain, octets, text, characters };
  std::uint16_t index;
  std::uint8_t sub;
  bool readable;
  bool writable;
  Kind kind;
  std::uint32_t capacity;
  Bytes value;

  bool is_stream() const { return kind != Kind::number && kind != Kind::boolean; }
  Bytes shown() const;  ///< bytes that an upload returns
  void set(const Bytes& bytes);
};

class SdoServerModel {
 public:
  /// \a buffer: segments of a block download that are buffered before they are written to the object, 1…127; 0: the
  /// server has no block transfer.
  SdoServerModel(std::vector<SdoObject> objects, unsigned buffer) : objects_(std::move(objects)), buffer_(buffer) {}

  /// Processes a request of 8 bytes. Returns the answer, or no value if there is none.
  std::optional<SdoBytes> answer(const SdoBytes& request);
  /// Sends and returns the next segment of a block upload, or no value if there is none.
  std::optional<SdoBytes> segment();
  /// Calls both functions, for a controller that accepts every frame.
  std::vector<SdoBytes> answers(const SdoBytes& request);
  /// Lets an eighth of the time-out pass. Returns the frame that the server sends at its end, or no value.
  std::optional<SdoBytes> slice();
  /// Ends the open transfer because of the NMT state. [N8]
  void close() { state_ = State::idle; }

  const std::vector<SdoObject>& objects() const { return objects_; }
  bool is_open() const { return state_ != State::idle; }
  bool is_in_block() const { return state_ == State::block_download; }  ///< all but 80h are segments
  const SdoKey& key() const { return key_; }                            ///< object of the open transfer

  /// Returns a request that continues the open transfer, so that random inputs reach all states. \a shorter: the
  /// download ends before all its data are sent, or the last segment of a block upload is not acknowledged. The data
  /// bytes of segments are 0.
  SdoBytes continued(bool shorter) const;

 private:
  enum class State {
    idle,
    download,
    upload,
    block_download,
    block_download_end,
    block_upload_ready,
    block_upload,
    block_upload_end
  };
  using Answer = std::optional<SdoBytes>;

  Answer answer_by_command(const SdoBytes& request);
  Answer answer_to_receiver(const SdoBytes& request);
  Answer answer_to_sender(const SdoBytes& request);
  SdoBytes refuse(const SdoBytes& request, std::uint32_t code);
  SdoBytes abort(std::uint32_t code);
  SdoBytes head(unsigned command) const;
  SdoBytes head_with_size(unsigned command) const;

  SdoObject* find(const SdoBytes& request);
  bool has_index(const SdoBytes& request) const;
  std::uint32_t fault_of_access(const SdoBytes& request, bool upload);
  std::uint32_t fault_of_length(std::size_t length) const;
  std::uint32_t fault_of_total(std::size_t length) const;
  std::uint32_t fault_of_value() const;
  std::uint32_t take_size(const SdoBytes& request, bool announced);

  Answer initiate_upload(const SdoBytes& request);
  Answer initiate_download(const SdoBytes& request);
  Answer expedited(const SdoBytes& request);
  Answer take(const SdoBytes& request);
  Answer give(const SdoBytes& request);

  Answer initiate_block_download(const SdoBytes& request);
  Answer take_in_block(const SdoBytes& request);
  void collect(const SdoBytes& request);
  Answer end_block(bool all);
  Answer end_block_download(const SdoBytes& request);
  bool is_right_end(const SdoBytes& request) const;
  std::size_t unused_at_end() const;

  Answer initiate_block_upload(const SdoBytes& request);
  Answer start(const SdoBytes& request);
  Answer acknowledged(const SdoBytes& request);
  Answer end_block_upload(const SdoBytes& request);

  std::vector<SdoObject> objects_;
  std::size_t buffer_;
  State state_ = State::idle;
  SdoObject* object_ = nullptr;
  SdoKey key_{};
  unsigned idle_ = 0;  // eighths of the time-out without a frame
  std::uint8_t toggle_ = 0;
  bool sized_ = false;
  std::size_t size_ = 0;  // expected or maximum size of a download
  Bytes data_;            // received bytes, or bytes to send
  std::size_t done_ = 0;  // bytes acknowledged by the client, or passed to the object
  bool has_crc_ = false;
  std::size_t blksize_ = 0;
  std::size_t seq_ = 0;            // last segment of the block received in order, or sent
  std::size_t highest_ = 0;        // highest received sequence number of the block
  bool is_stuck_ = false;          // no segment of the previous block was in order
  bool has_acknowledged_ = false;  // a block was acknowledged
  bool last_sent_ = false;
  std::uint32_t fault_ = 0;  // fault of a segment, reported at the end of the block
  SdoBytes last_segment_{};
  SdoBytes reminder_{};  // last answer of a block download
};

}  // namespace test
