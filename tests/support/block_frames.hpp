// SPDX-License-Identifier: Apache-2.0
/// \file block_frames.hpp
/// The frames of block transfers on server channel 1 that are too many to be typed. [301:7.2.4.3.10, 7.2.4.3.13]
#pragma once

#include "fixture.hpp"

namespace test {

/// Bytes \a first, \a first + 1, … modulo 256. The domains of a fixture hold them from 1 on.
Bytes counting(std::size_t size, unsigned first = 1);

/// Where a fixture has its domain of \a size bytes.
struct Place {
  std::uint16_t index;
  std::uint8_t sub;
};
Place domain_of(std::uint32_t size);

/// Segment \a place (from 0) of \a data, with a sequence number; the last one of the data says so.
CO_IF_FRM block_segment(const Bytes& data, std::size_t place, unsigned seqno);

/// Sends segments \a place … \a place + \a number - 1 of \a data, numbered from \a seqno on.
void send_segments(Fixture& node, const Bytes& data, std::size_t place, std::size_t number, unsigned seqno = 1,
                   Where at = {__builtin_FILE(), __builtin_LINE()});

/// The node has sent segments \a place … \a place + \a number - 1 of \a data, numbered from 1, and nothing else.
void expect_segments(Fixture& node, const Bytes& data, std::size_t place, std::size_t number,
                     Where at = {__builtin_FILE(), __builtin_LINE()});

/// The node has acknowledged the last segment of a download. The size of the next block is of no interest then.
void expect_last_ack(Fixture& node, unsigned ackseq, Where at = {__builtin_FILE(), __builtin_LINE()});

/// The end of a block of \a data: command with the number of unused bytes, and the CRC. [301:7.2.4.3.11, 7.2.4.3.15]
CO_IF_FRM block_end(std::uint32_t identifier, const Bytes& data);

}  // namespace test
