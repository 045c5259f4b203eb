// SPDX-License-Identifier: Apache-2.0
#include "sdo_observer.hpp"

#include <algorithm>
#include <cstring>

namespace test {
namespace {

constexpr std::uint8_t abort_command = 0x80;

// Commands 110x xxx0b (block download) and 101x xx00b (block upload).
bool initiates_block_download(std::uint8_t command) { return (command & 0xE1U) == 0xC0; }
bool initiates_block_upload(std::uint8_t command) { return (command & 0xE3U) == 0xA0; }
bool ends_block_download(std::uint8_t command) { return (command & 0xE3U) == 0xC1; }

bool initiates(std::uint8_t command) {
  const unsigned specifier = command >> 5;
  return specifier == 1 || specifier == 2 || initiates_block_download(command) || initiates_block_upload(command);
}

}  // namespace

void SdoObserver::request(const CO_IF_FRM& frm) {
  const std::uint8_t command = frm.Data[0];
  if (frm.DLC != 8) {
    return;  // [D1]
  }
  if (phase_ == Phase::receiving && command != abort_command) {
    receive(frm);
    return;
  }
  if (phase_ == Phase::received && std::equal(last_segment_.begin(), last_segment_.end(), frm.Data)) {
    return;  // [D27]
  }
  request_ = Request{command, CO_DEV(frm.Data[1] | (frm.Data[2] << 8), frm.Data[3]), frm.Data[4]};
  if ((command >> 5) == 4 || (phase_ == Phase::sending && initiates(command))) {
    phase_ = Phase::closed;
  } else if (phase_ == Phase::offered && command == 0xA3) {
    phase_ = Phase::sending;
  } else if (phase_ == Phase::sending && command == 0xA2) {
    acknowledge(frm.Data[1], frm.Data[2]);
  }
}

std::string SdoObserver::taken(const CO_IF_FRM& frm) {
  if (forget_waiting(frm)) {
    return "";
  }
  if (phase_ == Phase::sending && frm.Data[0] != abort_command) {
    return ending_ ? fault_of_end(frm) : fault_of_segment(frm);
  }
  answer(frm);
  return "";
}

void SdoObserver::waiting(const std::vector<CO_IF_FRM>& frames) {
  for (const CO_IF_FRM& frm : frames) {
    if (!forget_waiting(frm)) {
      answer(frm);
    }
  }
  waiting_ = frames;
}

bool SdoObserver::forget_waiting(const CO_IF_FRM& frm) {
  const auto is_it = [&](const CO_IF_FRM& one) { return std::memcmp(one.Data, frm.Data, sizeof frm.Data) == 0; };
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), is_it);
  const bool known = found != waiting_.end();
  if (known) {
    waiting_.erase(found);
  }
  return known;
}

void SdoObserver::answer(const CO_IF_FRM& frm) {
  const std::uint8_t command = frm.Data[0];
  if (command == abort_command) {
    if (may_have_written()) {
      changeable_.streaming.insert(dev_);
    }
    phase_ = Phase::closed;
    request_.reset();
  } else if (command == 0xA2 && phase_ == Phase::receiving) {
    phase_ = last_ ? Phase::received : Phase::receiving;
    next_ = 1;
  } else if (request_) {
    const Request request = *request_;
    request_.reset();
    answer_to(request, command);
  }
}

void SdoObserver::answer_to(const Request& request, std::uint8_t answer) {
  const unsigned asked = request.command >> 5;
  const bool is_segment = asked == 0 && (answer >> 5) == 1 && phase_ == Phase::downloading;
  const bool is_end = ends_block_download(request.command) && answer == 0xA1 && phase_ == Phase::received;
  if (asked == 1 && answer == 0x60) {
    const bool expedited = (request.command & 0x02U) != 0;
    open(expedited ? Phase::closed : Phase::downloading, request.dev);
    if (expedited) {
      changeable_.completed.insert(request.dev);
    }
  } else if (initiates_block_download(request.command) && (answer >> 5) == 5) {
    open(Phase::receiving, request.dev);
  } else if (initiates_block_upload(request.command) && (answer >> 5) == 6) {
    open(Phase::offered, request.dev);
    blksize_ = request.blksize;
  } else if ((is_segment && (request.command & 0x01U) != 0) || is_end) {
    changeable_.completed.insert(dev_);
    phase_ = Phase::closed;
  }
}

void SdoObserver::open(Phase phase, std::uint32_t dev) {
  phase_ = phase;
  dev_ = dev;
  segments_ = 0;
  next_ = 1;
  last_ = false;
  ending_ = false;
}

// Processes a segment of a block download. [301:7.2.4.3.10] [D22]
void SdoObserver::receive(const CO_IF_FRM& frm) {
  if ((frm.Data[0] & 0x7FU) == next_ && !last_) {
    ++next_;
    ++segments_;
    last_ = (frm.Data[0] & 0x80U) != 0;
    std::copy_n(frm.Data, 8, last_segment_.begin());
  }
}

// Returns true if the server may have written a part of the object. Block downloads that fit into the buffer are
// written only at their end.
bool SdoObserver::may_have_written() const {
  const bool block = phase_ == Phase::receiving || phase_ == Phase::received;
  const bool was_full = segments_ > CO_SDO_BUF_SEG || (segments_ == CO_SDO_BUF_SEG && !last_);
  return phase_ == Phase::downloading || (block && was_full);
}

void SdoObserver::take_changeable(ChangeableEntries& all) {
  if (may_have_written()) {
    changeable_.streaming.insert(dev_);
  }
  all.completed.merge(changeable_.completed);
  all.streaming.merge(changeable_.streaming);
  changeable_ = {};
}

void SdoObserver::close() {
  phase_ = Phase::closed;
  request_.reset();
}

// Processes the client's acknowledge of a sub-block of an upload. [301:7.2.4.3.14]
void SdoObserver::acknowledge(std::uint8_t ackseq, std::uint8_t blksize) {
  if (last_ && ackseq + 1U == next_) {
    ending_ = true;
  } else if (ackseq >= next_ || blksize == 0 || blksize > 127) {
    phase_ = Phase::closed;
  } else {
    next_ = 1;
    last_ = false;
    blksize_ = blksize;
  }
}

std::string SdoObserver::fault_of_segment(const CO_IF_FRM& frm) {
  const unsigned seqno = frm.Data[0] & 0x7FU;
  if (last_ || next_ > blksize_) {
    return "a segment after the last one of its block";
  }
  if (seqno != next_) {
    return "not segment " + std::to_string(next_);
  }
  ++next_;
  last_ = (frm.Data[0] & 0x80U) != 0;
  std::copy_n(frm.Data, 8, last_segment_.begin());
  return "";
}

// Checks the end of a block upload. Bytes without data are 0. [301:7.2.4.3.15]
std::string SdoObserver::fault_of_end(const CO_IF_FRM& frm) {
  phase_ = Phase::closed;
  if ((frm.Data[0] & 0xE3U) != 0xC1) {
    return "not the end of the block upload";
  }
  const std::ptrdiff_t unused = (frm.Data[0] >> 2) & 7;
  const bool clean =
      std::all_of(last_segment_.end() - unused, last_segment_.end(), [](auto byte) { return byte == 0; });
  return clean ? "" : "bytes beyond the data of the last segment not 0";
}

}  // namespace test
