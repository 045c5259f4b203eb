// SPDX-License-Identifier: Apache-2.0
// SDO server: block transfers on a bus that loses, duplicates and delays frames at every position. With a CRC or an
// announced size, the transfer ends with correct data or an abort code, never with wrong data. [T11]
#include <algorithm>

#include "support/block_frames.hpp"

#if USE_SDO_BLOCK

namespace {

using namespace test;

// A node with a domain of \a size bytes at 2106h.
class Target {
 public:
  explicit Target(std::uint32_t size)
      : memory_(counting(size)),
        domain_{0, size, memory_.data()},
        setup_(Setup().only_small().with({CO_KEY(0x2106, 0, CO_OBJ_____RW), CO_TDOMAIN, CO_DATA(&domain_)})) {}

  // Runs a download. Checks that the data are correct after success, and that the server is idle afterwards.
  BlockResult download(const BlockOptions& options) {
    const Bytes data = counting(memory_.size(), 0x80);
    std::fill(memory_.begin(), memory_.end(), std::uint8_t{0});
    Fixture node(setup_);
    const BlockResult result = node.block_download(0x2106, 0, data, options);
    CHECK((result.abort != 0 || memory_ == data));
    check_serves(node);
    return result;
  }

  BlockResult upload(const BlockOptions& options) {
    const Bytes data = counting(memory_.size(), 0x80);
    memory_ = data;
    Fixture node(setup_);
    const BlockResult result = node.block_upload(0x2106, 0, options);
    CHECK((result.abort != 0 || result.data == data));
    check_serves(node);
    return result;
  }

 private:
  static void check_serves(Fixture& node) {
    node.after(node.sdo_time_out());
    node.frames();
    node.ask("601#A3DEADBE00000000", "581#80DEADBE01000405");
    node.ask("601#4000100000000000", "581#4300100091010F00");
  }

  Bytes memory_;
  CO_OBJ_DOM domain_;
  Setup setup_;
};

using Faults = std::set<unsigned> BlockOptions::*;
using Transfer = BlockResult (Target::*)(const BlockOptions&);

// Repeats the transfer with a fault in each of its frames in turn. Returns the number of aborted transfers.
unsigned aborts(Target& target, Transfer transfer, Faults faults, BlockOptions options = {}) {
  const BlockResult undisturbed = (target.*transfer)(options);
  REQUIRE(undisturbed.abort == 0);
  const bool by_client = faults != &BlockOptions::lost_answers;
  const unsigned frames = by_client ? undisturbed.requests : undisturbed.answers;
  unsigned aborted = 0;
  for (unsigned n = 0; n<frames; n += frames> 20 ? stride(37) : 1) {
    CAPTURE(n);
    options.*faults = {n};
    const BlockResult result = (target.*transfer)(options);
    aborted += result.abort != 0 ? 1U : 0U;
  }
  return aborted;
}

constexpr std::uint32_t sizes[] = {1, 7, 8, 888, 889, 890, 891, 900, 1800};

// In blocks of one segment, a repeated segment cannot be distinguished from the next one.
#if CO_SDO_BUF_SEG > 1

// Returns the number of aborts that are possible because of a last block of one or two segments: after a loss in it,
// the server cannot distinguish the remaining segment from a repeated one.
unsigned lonely(std::uint32_t size) {
  const std::uint32_t segments = (size + 6) / 7;
  const std::uint32_t rest = segments % CO_SDO_BUF_SEG;
  return segments > CO_SDO_BUF_SEG && (rest == 1 || rest == 2) ? 1 : 0;
}

TEST_CASE("SDO block download: any lost frame of the client except the initiate is repeated [T11]") {
  for (const std::uint32_t size : sizes) {
    CAPTURE(size);
    Target target(size);
    CHECK(aborts(target, &Target::download, &BlockOptions::lost_requests) <= 1 + lonely(size));
  }
}

TEST_CASE("SDO block download: any lost frame of the server except the last one is repeated [T11]") {
  for (const std::uint32_t size : sizes) {
    CAPTURE(size);
    Target target(size);
    CHECK(aborts(target, &Target::download, &BlockOptions::lost_answers) <= 1);
  }
}

TEST_CASE("SDO block download: any frame may be doubled or swapped with the next one [T11]") {
  for (const std::uint32_t size : sizes) {
    CAPTURE(size);
    Target target(size);
    CHECK(aborts(target, &Target::download, &BlockOptions::doubled_requests) == 0);
    CHECK(aborts(target, &Target::download, &BlockOptions::late_requests) == 0);
  }
}

TEST_CASE("SDO block download: faults without CRC are detected by the size, without size by the CRC [T11]") {
  for (const bool crc : {false, true}) {
    BlockOptions options;
    options.crc = crc;
    options.sized = !crc;
    for (const std::uint32_t size : {8U, 100U, 890U}) {
      CAPTURE(size);
      Target target(size);
      CHECK(aborts(target, &Target::download, &BlockOptions::lost_requests, options) <= 1 + lonely(size));
      CHECK(aborts(target, &Target::download, &BlockOptions::lost_answers, options) <= 1);
      CHECK(aborts(target, &Target::download, &BlockOptions::late_requests, options) == 0);
    }
  }
}

#endif

TEST_CASE("SDO block upload: any lost acknowledge or end of the client is repeated [T11]") {
  for (const std::uint32_t size : sizes) {
    CAPTURE(size);
    Target target(size);
    CHECK(aborts(target, &Target::upload, &BlockOptions::lost_requests) <= 2);
  }
}

TEST_CASE("SDO block upload: any lost segment of the server is repeated [T11]") {
  for (const std::uint32_t size : sizes) {
    CAPTURE(size);
    Target target(size);
    CHECK(aborts(target, &Target::upload, &BlockOptions::lost_answers) <= 2 + ((size + 6) / 7 == 128 ? 1U : 0U));
  }
}

TEST_CASE("SDO block upload: with small blocks any frame may be lost, doubled or swapped with the next one [T11]") {
  for (const Bytes& blksizes : {Bytes{5}, Bytes{2, 9}, Bytes{31}}) {
    BlockOptions options;
    options.blksizes = blksizes;
    for (const std::uint32_t size : {100U, 210U, 889U}) {
      CAPTURE(size);
      Target target(size);
      CHECK(aborts(target, &Target::upload, &BlockOptions::lost_requests, options) <= 2);
      CHECK(aborts(target, &Target::upload, &BlockOptions::lost_answers, options) <= 3);
      aborts(target, &Target::upload, &BlockOptions::doubled_requests, options);
      aborts(target, &Target::upload, &BlockOptions::late_requests, options);
    }
  }
}

TEST_CASE("SDO block: any two frames of up to 30 segments may be lost [T11]") {
  for (const std::uint32_t size : {15U, 210U}) {
    Target target(size);
    for (const Transfer transfer : {&Target::download, &Target::upload}) {
      const BlockResult undisturbed = (target.*transfer)({});
      for (unsigned first = 0; first < undisturbed.requests; ++first) {
        CAPTURE(size);
        CAPTURE(first);
        BlockOptions options;
        for (unsigned second = first + 1; second < undisturbed.requests; second += stride(11)) {
          options.lost_requests = {first, second};
          (target.*transfer)(options);
        }
        for (unsigned second = 0; second < undisturbed.answers; second += stride(11)) {
          options.lost_requests = {first};
          options.lost_answers = {second};
          (target.*transfer)(options);
        }
      }
    }
  }
}

TEST_CASE("SDO block upload: any two frames of the server of up to 30 segments may be lost [T11]") {
  Target target(210);
  for (const Bytes& blksizes : {Bytes{127}, Bytes{7}}) {
    BlockOptions options;
    options.blksizes = blksizes;
    const unsigned frames = target.upload(options).answers;
    for (unsigned first = 0; first < frames; ++first) {
      for (unsigned second = first + 1; second < frames; second += stride(11)) {
        CAPTURE(first);
        CAPTURE(second);
        options.lost_answers = {first, second};
        target.upload(options);
      }
    }
  }
}

}  // namespace

#endif
