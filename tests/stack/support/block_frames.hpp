// SPDX-License-Identifier: Apache-2.0
/// \file block_frames.hpp
/// Generates and checks the segments of block transfers on server channel 1. [301:7.2.4.3.10, 7.2.4.3.13]
#pragma once

#include "fixture.hpp"

namespace test {

/// Returns the bytes \a first, \a first + 1, … modulo 256. The domains of a fixture initially contain counting(size).
Bytes counting(std::size_t size, unsigned first = 1);

/// Index and sub-index of an object.
struct Place {
  std::uint16_t index;
  std::uint8_t sub;
};
/// Returns the object that is a fixture's domain of \a size bytes.
Place domain_of(std::uint32_t size);

/// Returns segment \a place (from 0) of \a data with sequence number \a seqno. Bit 7 is set in the last one of the
/// data.
CO_IF_FRM block_segment(const Bytes& data, std::size_t place, unsigned seqno);

/// Sends segments \a place … \a place + \a number - 1 of \a data, numbered from \a seqno on.
void send_segments(Fixture& node, const Bytes& data, std::size_t place, std::size_t number, unsigned seqno = 1,
                   Where at = {__builtin_FILE(), __builtin_LINE()});

/// Checks that the node has sent segments \a place … \a place + \a number - 1 of \a data, numbered from 1, and no other
/// frame.
void expect_segments(Fixture& node, const Bytes& data, std::size_t place, std::size_t number,
                     Where at = {__builtin_FILE(), __builtin_LINE()});

/// Checks that the node has acknowledged the last segment of a download. The blksize of the answer is ignored.
void expect_last_ack(Fixture& node, unsigned ackseq, Where at = {__builtin_FILE(), __builtin_LINE()});

/// Returns the end request of a block transfer of \a data, with the number of unused bytes and the CRC.
/// [301:7.2.4.3.11, 7.2.4.3.15]
CO_IF_FRM block_end(std::uint32_t identifier, const Bytes& data);

}  // namespace test
