// SPDX-License-Identifier: Apache-2.0
// SDO frames. [301:7.2.4.3]
#pragma once

#include "co_obj.h"
#include "co_sdo.h"
#include "wire/abort.hpp"
#include "wire/crc.hpp"
#include "wire/frame.hpp"

namespace co::wire {

inline constexpr uint8_t sdo_dlc = 8;
inline constexpr uint32_t expedited_bytes = 4;

// Services of the frames of a client (Request) and of a server (Response), in the order of the command specifiers, bits
// 7…5; those of block transfers (101b and 110b) are divided by the lowest bits.
enum class Request : uint8_t {
  download_segment,
  initiate_download,
  initiate_upload,
  upload_segment,
  abort,
  initiate_block_upload,
  end_block_upload,
  acknowledge_block,
  start_block_upload,
  initiate_block_download,
  end_block_download,
  unknown,
  block_segment,  // distinguished from the others only by the state of the transfer
};
enum class Response : uint8_t {
  upload_segment,
  download_segment,
  initiate_upload,
  initiate_download,
  abort,
  initiate_block_download,
  end_block_download,
  acknowledge_block,
  none,  // A3h is "start upload" of a client; no response has this command
  initiate_block_upload,
  end_block_upload,
  unknown,
  block_segment,  // distinguished from the others only by the state of the transfer
};
inline constexpr uint8_t command_count = 13;

// Bits of each command that must be 0, else the command is unknown. A server accepts an abort with any of these bits
// set: it never responds to an abort.
using ReservedBits = uint8_t[11];
inline constexpr ReservedBits request_reserved = {0x00, 0x10, 0x1F, 0x0F, 0x00, 0x18, 0x1C, 0x1C, 0x1C, 0x18, 0x02};
inline constexpr ReservedBits response_reserved = {0x00, 0x0F, 0x10, 0x1F, 0x1F, 0x18, 0x1C, 0x1C, 0xFF, 0x18, 0x02};

// Returns the number of a command byte in Request or Response.
constexpr uint8_t number_of_command(uint8_t command, const ReservedBits& reserved) {
  constexpr unsigned unknown = 11;
  unsigned number = command >> 5;
  if (number == 5) {
    number += command & 0x03U;
  } else if (number >= 6) {
    number = number == 6 ? 9 + (command & 0x01U) : unknown;
  }
  return static_cast<uint8_t>(number < unknown && (command & reserved[number]) != 0 ? unknown : number);
}

constexpr Request request_of(uint8_t command) {
  return static_cast<Request>(number_of_command(command, request_reserved));
}
constexpr Response response_of(uint8_t command) {
  return static_cast<Response>(number_of_command(command, response_reserved));
}

inline constexpr uint8_t toggle_bit = 0x10;
constexpr uint8_t toggle(const CO_IF_FRM& frame) { return frame.Data[0] & toggle_bit; }

// Returns an SDO frame whose unused bytes are 0. [301:7.2.4.3]
inline CO_IF_FRM empty_frame(uint32_t identifier) { return empty_frame(identifier, sdo_dlc); }

// Returns the multiplexer (index in bytes 1 and 2, sub-index in byte 3) as a key without flags. low: bytes 0…3
constexpr uint32_t multiplexer_of(uint32_t low) { return ((low << 8) & 0xFFFF0000U) | ((low >> 16) & 0xFF00U); }
inline uint32_t multiplexer(const CO_IF_FRM& frame) { return multiplexer_of(get_low(frame)); }

// Returns the bytes 0…3 of a frame: command byte and multiplexer.
constexpr uint32_t head(uint8_t command, uint32_t key) {
  return command | ((key >> 8) & 0x00FFFF00U) | ((key & 0xFF00U) << 16);
}
inline void put_head(CO_IF_FRM& frame, uint8_t command, uint32_t key) { put_low(frame, head(command, key)); }

// Sets the bytes 0…3 of a response to an initiate request, whose multiplexer it repeats.
inline void put_reply(CO_IF_FRM& answer, uint8_t command, const CO_IF_FRM& request) {
  put_low(answer, (get_low(request) & 0xFFFFFF00U) | command);
}

// Command byte of an initiate frame: 0ssx nnes. e: expedited, s: size indicated, n: bytes of the four that contain no
// data.
constexpr bool is_expedited(uint8_t command) { return (command & 0x02) != 0; }
constexpr bool is_size_indicated(uint8_t command) { return (command & 0x01) != 0; }
constexpr uint32_t expedited_length(uint8_t command) { return expedited_bytes - ((command >> 2) & 0x03U); }

// Command byte of a segment: 000t nnnc. n: bytes of the seven that contain no data, c: no more segments.
constexpr uint32_t segment_length(uint8_t command) { return segment_bytes - ((command >> 1) & 0x07U); }
constexpr bool is_last_segment(uint8_t command) { return (command & 0x01) != 0; }

inline constexpr uint8_t abort_command = 0x80;
inline CO_IF_FRM abort_frame(uint32_t identifier, uint32_t key, Abort code) {
  CO_IF_FRM frame = empty_frame(identifier);
  put_head(frame, abort_command, key);
  put_high(frame, static_cast<uint32_t>(code));
  return frame;
}

// Returns the abort code in an abort frame; general for the code 0, which would mean success.
inline Abort abort_code_in(const CO_IF_FRM& frame) {
  const Abort code{get_high(frame)};
  return code != Abort::none ? code : Abort::general;
}

// Properties of the four initiate requests.
constexpr bool initiates_block(uint8_t command) { return (command & 0x80) != 0; }
constexpr bool initiates_upload(uint8_t command) { return ((command ^ (command << 1)) & 0x80) != 0; }

// Command bytes of the responses of a server.
inline constexpr uint8_t initiate_download_response = 0x60;
constexpr uint8_t initiate_upload_response(bool sized) { return sized ? 0x41 : 0x40; }
constexpr uint8_t expedited_upload_response(uint32_t length) {
  return static_cast<uint8_t>(0x43U | ((expedited_bytes - length) << 2));
}
constexpr uint8_t download_segment_response(uint8_t toggle) { return static_cast<uint8_t>(0x20U | toggle); }

// Command bytes of the requests of a client.
inline constexpr uint8_t initiate_upload_request = 0x40;
inline constexpr uint8_t initiate_download_request_sized = 0x21;
constexpr uint8_t expedited_download_request(uint32_t length) {
  return static_cast<uint8_t>(0x23U | ((expedited_bytes - length) << 2));
}
constexpr uint8_t upload_segment_request(uint8_t toggle) { return static_cast<uint8_t>(0x60U | toggle); }

// Returns the bytes of data in a segment of a transfer whose size was indicated, with left bytes still to be
// transferred. n = 0 in the last segment indicates no size: it contains the remaining bytes. [301:7.2.4.3.4, 7.2.4.3.6]
constexpr uint32_t segment_length(uint8_t command, uint32_t left) {
  const bool is_open = (command & 0x0F) == 0x01;
  return is_open && left - 1 < segment_bytes ? left : segment_length(command);
}

// Returns the command byte of a segment of a client or a server.
constexpr uint8_t segment(uint8_t toggle, uint32_t length, bool last) {
  return static_cast<uint8_t>(toggle | ((segment_bytes - length) << 1) | (last ? 1U : 0U));
}

// Block transfer. The frames of a block download and of a block upload have the same format, in opposite directions.
// [301:7.2.4.3.9-16]
inline constexpr uint8_t max_blksize = 127;
constexpr bool is_blksize(uint8_t blksize) { return blksize >= 1 && blksize <= max_blksize; }

// Command bytes of the side that sends the data. Initiate: 110x xcss, c: CRC supported, s: size indicated; end: 110n
// nnx1, n: bytes of the last segment that contain no data.
constexpr uint8_t initiate_block(bool sized) { return sized ? 0xC6 : 0xC4; }
constexpr uint8_t end_block(uint32_t unused) { return static_cast<uint8_t>(0xC1U | (unused << 2)); }
constexpr uint32_t unused_in_block(uint8_t command) { return (command >> 2) & 0x07U; }
constexpr bool is_end_of_blocks(uint8_t command) { return (command & 0xE3) == 0xC1; }
constexpr bool is_block_sized(uint8_t command) { return (command & 0x02) != 0; }

// Command bytes of the side that receives the data: 101x xcss.
inline constexpr uint8_t accept_block = 0xA4;
inline constexpr uint8_t confirm_block = 0xA1;
inline constexpr uint8_t acknowledge_block = 0xA2;
inline constexpr uint8_t start_block = 0xA3;

// Returns bit c of an initiate command: the side that sends it supports the CRC.
constexpr bool has_crc(uint8_t command) { return (command & 0x04) != 0; }

// Command byte of a segment of a block: cnnn nnnn, c: no more segments, n: sequence number, from 1.
constexpr uint8_t seqno(uint8_t command) { return command & 0x7FU; }
constexpr bool is_last_in_block(uint8_t command) { return (command & 0x80) != 0; }
constexpr uint8_t block_segment(uint8_t number, bool last) {
  return static_cast<uint8_t>(number | (last ? 0x80U : 0U));
}

// Returns whether n bytes are equal.
inline bool is_equal(const uint8_t* a, const uint8_t* b, uint32_t n) {
  while (n != 0 && *a == *b) {
    ++a;
    ++b;
    --n;
  }
  return n == 0;
}

static_assert(request_of(0x2F) == Request::initiate_download && request_of(0x30) == Request::unknown);
static_assert(request_of(0x40) == Request::initiate_upload && request_of(0x41) == Request::unknown);
static_assert(request_of(0x70) == Request::upload_segment && request_of(0x61) == Request::unknown);
static_assert(request_of(0x80) == Request::abort && request_of(0x9F) == Request::abort);
static_assert(request_of(0xA4) == Request::initiate_block_upload && request_of(0xA5) == Request::unknown);
static_assert(request_of(0xA1) == Request::end_block_upload && request_of(0xA2) == Request::acknowledge_block);
static_assert(request_of(0xA3) == Request::start_block_upload && request_of(0xA8) == Request::unknown);
static_assert(request_of(0xC6) == Request::initiate_block_download && request_of(0xC8) == Request::unknown);
static_assert(request_of(0xDD) == Request::end_block_download && request_of(0xC3) == Request::unknown);
static_assert(request_of(0xE0) == Request::unknown && request_of(0xFF) == Request::unknown);
static_assert(response_of(0x30) == Response::download_segment && response_of(0x31) == Response::unknown);
static_assert(response_of(0x4F) == Response::initiate_upload && response_of(0x50) == Response::unknown);
static_assert(response_of(0x60) == Response::initiate_download && response_of(0x61) == Response::unknown);
static_assert(response_of(0x80) == Response::abort && response_of(0x81) == Response::unknown);
static_assert(response_of(0xA0) == Response::initiate_block_download && response_of(0xA3) == Response::unknown);
static_assert(response_of(0xC2) == Response::initiate_block_upload && response_of(0xDD) == Response::end_block_upload);
static_assert(initiates_upload(0x40) && initiates_upload(0xA4) && !initiates_upload(0x2F) && !initiates_upload(0xC6));
static_assert(initiates_block(0xA4) && initiates_block(0xC6) && !initiates_block(0x40) && !initiates_block(0x2F));
static_assert(expedited_upload_response(4) == 0x43 && expedited_upload_response(3) == 0x47);
static_assert(expedited_upload_response(2) == 0x4B && expedited_upload_response(1) == 0x4F);
static_assert(expedited_download_request(4) == 0x23 && expedited_download_request(1) == 0x2F);
static_assert(expedited_length(0x2F) == 1 && expedited_length(0x23) == 4 && !is_size_indicated(0x22));
static_assert(segment_length(0x0F) == 0 && segment_length(0x00) == 7 && segment_length(0x1D) == 1);
static_assert(segment_length(0x11, 3) == 3 && segment_length(0x01, 0) == 7 && segment_length(0x01, 8) == 7);
static_assert(segment_length(0x10, 3) == 7 && segment_length(0x03, 3) == 6 && segment_length(0x01, 7) == 7);
static_assert(segment(0x10, 2, true) == 0x1B && download_segment_response(0x10) == 0x30);
static_assert(is_end_of_blocks(0xC1) && is_end_of_blocks(0xDD) && !is_end_of_blocks(0xC3) && !is_end_of_blocks(0xC4));
static_assert(end_block(3) == 0xCD && unused_in_block(0xDD) == 7 && block_segment(1, true) == 0x81);
static_assert(has_crc(0xA4) && !has_crc(0xC2) && is_block_sized(0xC2) && !is_block_sized(0xC4));

static_assert(head(0x40, 0x10180200) == 0x02101840 && multiplexer_of(0x02101840) == 0x10180200);

}  // namespace co::wire
