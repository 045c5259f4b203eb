// SPDX-License-Identifier: Apache-2.0
#include "block_client.hpp"

#include <algorithm>

#include "fixture.hpp"

namespace test {
namespace {

constexpr std::uint32_t timed_out = 0x05040000;
constexpr std::uint32_t unknown_command = 0x05040001;
constexpr std::uint32_t wrong_blksize = 0x05040002;
constexpr std::uint32_t wrong_sequence = 0x05040003;
constexpr std::uint32_t wrong_crc = 0x05040004;
constexpr std::uint32_t wrong_length = 0x06070010;

constexpr unsigned patience = 3;  // repetitions of a request that is not answered

CO_IF_FRM request(std::uint8_t command) {
  CO_IF_FRM frm{};
  CO_SET_ID(&frm, 0x601);
  CO_SET_DLC(&frm, 8);
  CO_SET_BYTE(&frm, command, 0);
  return frm;
}

CO_IF_FRM initiate(std::uint8_t command, std::uint16_t index, std::uint8_t sub) {
  CO_IF_FRM frm = request(command);
  CO_SET_WORD(&frm, index, 1);
  CO_SET_BYTE(&frm, sub, 3);
  return frm;
}

}  // namespace

// The bus ------------------------------------------------------------------------------------------------------------

void BlockClient::send(const CO_IF_FRM& frm) {
  const unsigned number = result_.requests++;
  if (options_.lost_requests.count(number) > 0) {
    return;
  }
  if (options_.late_requests.count(number) > 0) {
    held_.push_back(frm);
    return;
  }
  deliver(frm);
  if (options_.doubled_requests.count(number) > 0) {
    deliver(frm);
  }
  while (!held_.empty()) {
    deliver(held_.front());
    held_.pop_front();
  }
}

void BlockClient::deliver(const CO_IF_FRM& frm) {
  node_.rx(frm, at_);
  collect();
}

// Moves the answers of the server on channel 1 to the inbox, without those that are to be lost; discards other frames.
void BlockClient::collect() {
  for (const Sent& sent : node_.can.sent) {
    if (sent.frm.Identifier == 0x581 && options_.lost_answers.count(result_.answers++) == 0) {
      inbox_.push_back(sent.frm);
    }
  }
  node_.can.sent.clear();
}

// Waits for a frame of the server, at most \a slices eighths of the server's time-out. Returns false if none arrives.
bool BlockClient::wait(unsigned slices) {
  for (; inbox_.empty() && !held_.empty(); held_.pop_front()) {
    deliver(held_.front());
  }
  for (unsigned n = 0; n < slices && inbox_.empty(); ++n) {
    node_.loop(at_);
    collect();
    if (inbox_.empty()) {
      node_.after(std::chrono::milliseconds{CO_SDO_TIMEOUT / 8 + 1}, at_);
      collect();
    }
  }
  if (inbox_.empty()) {
    return false;
  }
  answer_ = inbox_.front();
  inbox_.pop_front();
  return true;
}

// Waits for an answer. Returns false if none arrives or it is an abort.
bool BlockClient::next(unsigned slices) {
  if (!wait(slices)) {
    give_up(timed_out);
    return false;
  }
  if (is(0x80)) {
    result_.abort = CO_GET_LONG(&answer_, 4);
    return false;
  }
  return true;
}

bool BlockClient::give_up(std::uint32_t code) {
  CO_IF_FRM frm = multiplexer_;
  CO_SET_BYTE(&frm, 0x80, 0);
  CO_SET_LONG(&frm, code, 4);
  send(frm);
  result_.abort = code;
  result_.by_client = true;
  return false;
}

// Download -----------------------------------------------------------------------------------------------------------

BlockResult BlockClient::download(std::uint16_t index, std::uint8_t sub, const Bytes& data) {
  const unsigned command = 0xC0U | (options_.crc ? 0x04U : 0U) | (options_.sized ? 0x02U : 0U);
  multiplexer_ = initiate(static_cast<std::uint8_t>(command), index, sub);
  CO_IF_FRM first = multiplexer_;
  CO_SET_LONG(&first, options_.sized ? static_cast<std::uint32_t>(data.size()) + options_.announced_more : 0, 4);
  send(first);
  if (is_accepted() && send_blocks(data)) {
    end_download(data);
  }
  return result_;
}

bool BlockClient::is_accepted() {
  if (!next()) {
    return false;
  }
  const bool same = std::equal(answer_.Data + 1, answer_.Data + 4, multiplexer_.Data + 1);
  if (!same || !(is(0xA4) || is(0xA0))) {
    return give_up(unknown_command);
  }
  present_blksize_ = answer_.Data[4];
  has_crc_ = options_.crc && is(0xA4);
  return is_blksize(present_blksize_) || give_up(wrong_blksize);
}

bool BlockClient::send_blocks(const Bytes& data) {
  const std::size_t all = std::max<std::size_t>(1, (data.size() + 6) / 7);
  for (std::size_t done = 0; done < all;) {
    const std::size_t end = std::min(all, done + present_blksize_);
    send_block(data, done, end);
    if (!next()) {
      return false;
    }
    if (is(0xA4)) {
      continue;  // The server has received no segment and repeats its first response.
    }
    if (!is(0xA2)) {
      return give_up(unknown_command);
    }
    if (answer_.Data[1] > end - done) {
      return give_up(wrong_sequence);
    }
    done += answer_.Data[1];
    present_blksize_ = answer_.Data[2];
    if (!is_blksize(present_blksize_)) {
      return give_up(wrong_blksize);
    }
  }
  return true;
}

// Sends the segments first … end - 1 (from 0) of the data as a sub-block.
void BlockClient::send_block(const Bytes& data, std::size_t first, std::size_t end) {
  for (std::size_t n = first; n < end && inbox_.empty(); ++n) {
    const std::size_t length = std::min<std::size_t>(7, data.size() - 7 * n);
    const bool last = 7 * n + length == data.size();
    CO_IF_FRM frm = request(static_cast<std::uint8_t>((n - first + 1) | (last ? 0x80U : 0U)));
    std::copy_n(data.begin() + static_cast<std::ptrdiff_t>(7 * n), length, frm.Data + 1);
    send(frm);
  }
}

bool BlockClient::end_download(const Bytes& data) {
  const std::size_t unused = data.empty() ? 7 : (7 - data.size() % 7) % 7;
  CO_IF_FRM frm = request(static_cast<std::uint8_t>(0xC1U | (unused << 2)));
  CO_SET_WORD(&frm, has_crc_ ? crc_16(data) ^ options_.crc_error : 0U, 1);
  for (unsigned n = 0; n < patience; ++n) {
    send(frm);
    if (!next()) {
      return false;
    }
    if (is(0xA1)) {
      return true;
    }
    if (!is(0xA2)) {  // A repeated A2h means that the end was lost; it is sent again.
      return give_up(unknown_command);
    }
  }
  return give_up(timed_out);
}

// Upload -------------------------------------------------------------------------------------------------------------

BlockResult BlockClient::upload(std::uint16_t index, std::uint8_t sub) {
  multiplexer_ = initiate(options_.crc ? 0xA4 : 0xA0, index, sub);
  CO_IF_FRM first = multiplexer_;
  present_blksize_ = next_blksize();
  CO_SET_BYTE(&first, present_blksize_, 4);
  CO_SET_BYTE(&first, options_.pst, 5);
  send(first);
  if (!next()) {
    return result_;
  }
  if ((answer_.Data[0] & 0xE0U) == 0x40) {
    upload_ordinarily();
  } else if (!std::equal(answer_.Data + 1, answer_.Data + 4, multiplexer_.Data + 1) ||
             (answer_.Data[0] & 0xF9U) != 0xC0) {
    give_up(unknown_command);
  } else {
    upload_blocks();
  }
  return result_;
}

std::uint8_t BlockClient::next_blksize() { return options_.blksizes[block_++ % options_.blksizes.size()]; }

bool BlockClient::upload_blocks() {
  has_crc_ = options_.crc && (answer_.Data[0] & 0x04U) != 0;
  sized_ = (answer_.Data[0] & 0x02U) != 0;
  size_ = CO_GET_LONG(&answer_, 4);
  send(request(0xA3));
  while (!last_) {
    if (!receive_block()) {
      return false;
    }
  }
  return end_upload();
}

// Receives segments until the last of the block, or until a time without frames, and acknowledges them. If no segment
// was received, the last acknowledge was lost and is repeated.
bool BlockClient::receive_block() {
  std::uint8_t good = 0;
  bool heard = false;
  for (bool ended = false; !ended && wait(2); heard = true) {
    if (is(0x80)) {
      result_.abort = CO_GET_LONG(&answer_, 4);
      return false;
    }
    ended = take_segment(good);
  }
  silences_ = heard ? 0 : silences_ + 1;
  if (silences_ > patience) {
    return give_up(timed_out);
  }
  if (heard || acknowledge_.DLC == 0) {
    present_blksize_ = next_blksize();
    acknowledge_ = request(0xA2);
    CO_SET_BYTE(&acknowledge_, good, 1);
    CO_SET_BYTE(&acknowledge_, present_blksize_, 2);
  }
  send(acknowledge_);
  return true;
}

// Stores a segment if it is in order, and updates \a good, the sequence number of the last segment in order. Returns
// true for the last segment of the block.
bool BlockClient::take_segment(std::uint8_t& good) {
  const unsigned seqno = answer_.Data[0] & 0x7FU;
  const bool last = (answer_.Data[0] & 0x80U) != 0;
  if (seqno == good + 1U) {
    ++good;
    last_ = last;
    result_.data.insert(result_.data.end(), answer_.Data + 1, answer_.Data + 8);
  }
  return last || seqno == present_blksize_;
}

bool BlockClient::end_upload() {
  for (unsigned n = 0; !wait(2); ++n) {
    if (n == patience) {
      return give_up(timed_out);
    }
    send(acknowledge_);
  }
  inbox_.push_front(answer_);
  if (!next()) {
    return false;
  }
  const unsigned unused = (answer_.Data[0] >> 2) & 7U;
  if ((answer_.Data[0] & 0xE3U) != 0xC1) {
    return give_up(unknown_command);
  }
  result_.data.resize(result_.data.size() - unused);
  if (sized_ && result_.data.size() != size_) {
    return give_up(wrong_length);
  }
  if (has_crc_ && CO_GET_WORD(&answer_, 1) != crc_16(result_.data)) {
    return give_up(wrong_crc);
  }
  send(request(0xA1));
  return true;
}

// Continues with an expedited or segmented upload, to which the server has switched. [301:7.2.4.3.12]
bool BlockClient::upload_ordinarily() {
  if ((answer_.Data[0] & 0xF3U) == 0x43) {
    result_.data.assign(answer_.Data + 4, answer_.Data + 8 - ((answer_.Data[0] >> 2) & 3U));
    return true;
  }
  for (std::uint8_t toggle = 0;; toggle ^= 0x10U) {
    send(request(static_cast<std::uint8_t>(0x60U | toggle)));
    if (!next()) {
      return false;
    }
    if ((answer_.Data[0] & 0xF0U) != toggle) {
      return give_up(unknown_command);
    }
    result_.data.insert(result_.data.end(), answer_.Data + 1, answer_.Data + 8 - ((answer_.Data[0] >> 1) & 7U));
    if ((answer_.Data[0] & 1U) != 0) {
      return true;
    }
  }
}

}  // namespace test
