// SPDX-License-Identifier: Apache-2.0
// Causes in SDO transfers, and two servers that answer as one. [301:7.2.4]
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "explain/check.hpp"
#include "trace/decode.hpp"

namespace lexican::explain {
namespace {

using describe::SdoTransfer;

constexpr unsigned refusals_needed = 3;
constexpr unsigned silences_needed = 2;  // requests without answer in a row
constexpr unsigned stalls_needed = 2;    // transfers that stop in the middle
constexpr unsigned double_answers_needed = 3;
constexpr std::size_t most_refusals = 4096;
constexpr std::uint32_t wrong_toggle = 0x05030000;
constexpr std::uint32_t timed_out = 0x05040000;
constexpr std::uint32_t no_object = 0x06020000;
constexpr std::uint32_t no_sub_index = 0x06090011;

struct Advice {
  std::uint32_t code;
  const char* text;
};

/// Remedies by abort code. [301:7.2.4.3.17]
constexpr Advice advices[] = {
    {0x06010001, "the object is write-only: do not read it"},
    {0x06010002, "the object is read-only: do not write it"},
    {0x06020000, "the device has no such object: compare its description with its version (1018h:03)"},
    {0x06040041, "the object cannot be mapped: choose another one"},
    {0x06040042, "fewer objects in this PDO: 8 bytes are the limit"},
    {0x06070010, "write the length that the type of the object has"},
    {0x06070012, "write the length that the type of the object has"},
    {0x06070013, "write the length that the type of the object has"},
    {0x06090011, "the device has no such sub-index: compare its description with its version"},
    {0x06090030, "write a value that the device permits"},
    {0x06090031, "write a lower value"},
    {0x06090032, "write a higher value"},
    {0x08000020, "the device cannot store it now: try in another state (nmt preop)"},
    {0x08000021, "the device is switched to local control"},
    {0x08000022, "enter another state of the device first: nmt preop for PDO parameters, the controlword for drives"},
};

class SdoCheck : public Check {
 public:
  using Check::Check;

  void frame(const Entry& entry) override {
    const std::optional<std::uint16_t> identifier = plain_identifier(entry.frame);
    const auto node = static_cast<std::uint8_t>(identifier.value_or(0) & 0x7FU);
    if (!identifier || node == 0 || entry.frame.DLC != 8) {
      return;
    }
    if (*identifier >> 7 == 12) {
      request(servers_[node], entry);
    } else if (*identifier >> 7 == 11) {
      answer(node, entry);
    }
  }

  void transfer(std::uint8_t node, const SdoTransfer& transfer) override {
    Server& server = servers_[node];
    const bool is_timed_out =
        transfer.end == SdoTransfer::End::unanswered ||
        ((transfer.end == SdoTransfer::End::cancelled || transfer.end == SdoTransfer::End::refused) &&
         transfer.abort_code == timed_out);
    if (transfer.wrong_toggles > 0 || transfer.abort_code == wrong_toggle) {
      report_toggle(node, transfer);
    }
    if (transfer.lost_segments > 0) {
      server.lost += transfer.lost_segments;
      report_lost(node, transfer);
    }
    if (transfer.is_aborted_only || transfer.is_cut) {
      return;
    }
    if (transfer.is_displaced) {
      displaced(node, transfer);
    } else if (is_timed_out && transfer.is_answered) {
      ++server.stalls;
      report_lost(node, transfer);
    } else if (is_timed_out) {
      unanswered(node, transfer);
    } else {
      constexpr unsigned few = 4;  // a device that starts
      if (server.silences.count() < few) {
        findings_.remove(CauseId::sdo_busy, node, 0);
      }
      server.silences.clear();
    }
    if (transfer.end == SdoTransfer::End::refused && transfer.abort_code != wrong_toggle) {
      refused(node, transfer);
    } else if (transfer.end == SdoTransfer::End::done) {
      succeeded(node, transfer);
    }
  }

 private:
  struct Server {
    unsigned open = 0;  ///< requests without an answer
    Micros requested = 0;
    bool is_streaming = false;  ///< block upload: the server sends segments without a request for each
    std::uint32_t object = 0;   ///< index and sub-index of the last answer
    unsigned answers = 0;       ///< since the first one that came twice
    Evidence doubled;
    Evidence silences;
    Evidence displaced;
    unsigned stalls = 0;
    unsigned lost = 0;
    Evidence losses;
    Evidence toggles;
  };
  using Access = std::tuple<std::uint8_t, std::uint16_t, std::uint8_t, bool>;
  struct Refusal {
    std::uint32_t code = 0;
    Evidence evidence;
  };

  static std::string words(const SdoTransfer& transfer, const std::string& object) {
    return (transfer.is_download ? "write " : "read ") + object;
  }

  static void request(Server& server, const Entry& entry) {
    constexpr Micros answer_time = 100 * one_ms;
    const std::uint8_t first = entry.frame.Data[0];
    const unsigned command = first >> 5;
    if (first == 0x80 || (command == 5 && (first & 3U) == 1)) {
      server.is_streaming = false;
      return;  // an abort, or the end of a block upload, has no answer
    }
    server.is_streaming = command == 5 && (first & 3U) >= 2;
    server.open = entry.time - server.requested > answer_time ? 1 : std::min(server.open + 1, 64U);
    server.requested = entry.time;
  }

  /// Two servers with one node-ID answer each request twice.
  void answer(std::uint8_t node, const Entry& entry) {
    Server& server = servers_[node];
    const unsigned command = entry.frame.Data[0] >> 5;
    if (server.is_streaming || command == 6) {
      return;
    }
    const std::uint32_t object = CO_GET_LONG(&entry.frame, 0) >> 8;
    const bool is_same = std::exchange(server.object, object) == object && command >= 2 && command <= 4;
    if (server.open > 0 || !is_same) {
      server.open -= std::min(server.open, 1U);
      server.answers += server.doubled.count() != 0 ? 1U : 0U;
      return;
    }
    server.doubled.add(entry, "a second answer to one request");
    if (server.doubled.is_news() && server.doubled.count() >= double_answers_needed &&
        server.doubled.count() * 2 >= server.answers) {
      Finding finding{CauseId::same_node_id, node, 1, {}, {}, {}, {}, server.doubled};
      finding.title = fmt::format("two devices have the node-ID {}", node);
      finding.text =
          fmt::format("SDO requests to node {} were answered twice, {} times.", node, server.doubled.count());
      finding.check = fmt::format("switch off one of them: lexican scan has to lose node {}", node);
      finding.fix = "give one of them another node-ID: its switches, or lexican lss assign SERIAL=ID --store";
      findings_.put(std::move(finding));
    }
  }

  void refused(std::uint8_t node, const SdoTransfer& transfer) {
    const bool is_optional = transfer.index >= 0x1400 && transfer.index < 0x1A00 && transfer.sub_index > 2;
    if (is_optional && !transfer.is_download && transfer.abort_code == no_sub_index) {
      return;  // a program looks for an optional parameter of a PDO
    }
    const Access access{node, transfer.index, transfer.sub_index, transfer.is_download};
    if (refusals_.size() >= most_refusals && refusals_.find(access) == refusals_.end()) {
      return;
    }
    Refusal& refusal = refusals_[access];
    refusal.code = transfer.abort_code;
    const std::string object = facts_.object(node, transfer.index, transfer.sub_index);
    const std::string code = trace::abort_code(transfer.abort_code);
    refusal.evidence.add(transfer.time, words(transfer, object) + " refused: " + code);
    // A program may look once for an object that not all devices have.
    const bool is_search =
        !transfer.is_download && (transfer.abort_code == no_object || transfer.abort_code == no_sub_index);
    if (refusal.evidence.count() < (is_search ? 2 * refusals_needed : refusals_needed) || !refusal.evidence.is_news()) {
      return;
    }
    const auto* const advice = std::find_if(std::begin(advices), std::end(advices),
                                            [&](const Advice& row) { return row.code == transfer.abort_code; });
    Finding finding{CauseId::sdo_refused, node, detail_of(access), {}, {}, {}, {}, refusal.evidence};
    finding.title = fmt::format("node {} refuses to {} again and again", node, words(transfer, object));
    finding.text = fmt::format("It refused {} times: {} {}.", refusal.evidence.count(), code,
                               trace::abort_meaning(transfer.abort_code));
    finding.check = fmt::format("lexican read {} {:04X}:{:X}", node, transfer.index, transfer.sub_index);
    finding.fix =
        advice != std::end(advices) ? advice->text : "the manual of the device says when it refuses this object";
    findings_.put(std::move(finding));
  }

  void succeeded(std::uint8_t node, const SdoTransfer& transfer) {
    const Access access{node, transfer.index, transfer.sub_index, transfer.is_download};
    if (refusals_.erase(access) != 0) {
      findings_.remove(CauseId::sdo_refused, node, detail_of(access));
    }
  }

  static std::uint32_t detail_of(const Access& access) {
    return static_cast<std::uint32_t>(std::get<1>(access)) << 9 | static_cast<std::uint32_t>(std::get<2>(access)) << 1 |
           (std::get<3>(access) ? 1U : 0U);
  }

  /// The device is there, and its server is silent.
  void unanswered(std::uint8_t node, const SdoTransfer& transfer) {
    constexpr Micros alive = 3 * one_second;
    const NodeFacts& facts = facts_.node(node);
    if (!facts.is_heard || facts_.now() - std::min(facts.heard, facts_.now()) > alive) {
      return;
    }
    Server& server = servers_[node];
    const std::string object = facts_.object(node, transfer.index, transfer.sub_index);
    server.silences.add(transfer.begin, words(transfer, object) + ": no answer");
    if (server.silences.count() < silences_needed) {
      return;
    }
    const bool is_stopped = facts.state == nmt::stopped;
    Finding finding{CauseId::sdo_busy, node, 0, {}, {}, {}, {}, server.silences};
    finding.title = fmt::format("node {} does not answer SDO requests", node);
    finding.text = fmt::format("{} requests in a row had no answer, and the device sends other messages. {}",
                               server.silences.count(),
                               is_stopped ? "It is Stopped, where it has no SDO."
                                          : "Its SDO server hangs, is busy with a long work, or is disabled.");
    finding.check = fmt::format("lexican read {} 1000 --timeout 10000", node);
    finding.fix = is_stopped ? fmt::format("lexican nmt preop {}", node)
                             : fmt::format("a longer time-out of the master; else lexican nmt reset {}", node);
    findings_.put(std::move(finding));
  }

  /// A request has ended the transfer before: of another client, or of one that has no patience.
  void displaced(std::uint8_t node, const SdoTransfer& transfer) {
    constexpr Micros patience = 20 * one_ms;
    Server& server = servers_[node];
    if (facts_.now() - std::min(transfer.time, facts_.now()) > patience) {
      transfer.is_answered ? (++server.stalls, report_lost(node, transfer)) : unanswered(node, transfer);
      return;
    }
    server.displaced.add(transfer.time, words(transfer, facts_.object(node, transfer.index, transfer.sub_index)) +
                                            ": another request came before its end");
    if (server.displaced.count() >= 2) {
      Finding finding{CauseId::sdo_busy, node, 1, {}, {}, {}, {}, server.displaced};
      finding.title = fmt::format("two clients use the SDO server of node {} at the same time", node);
      finding.text = fmt::format(
          "{} transfers were broken by the request of another one on {:03X}h. A server has one "
          "transfer at a time.",
          server.displaced.count(), 0x600U + node);
      finding.check = "stop one of the masters or programs on the bus";
      finding.fix = "give the second client another SDO (1201h), or let one program serve both";
      findings_.put(std::move(finding));
    }
  }

  void report_lost(std::uint8_t node, const SdoTransfer& transfer) {
    Server& server = servers_[node];
    const std::string object = facts_.object(node, transfer.index, transfer.sub_index);
    server.losses.add(transfer.time,
                      words(transfer, object) +
                          (transfer.lost_segments > 0 ? ": segments are sent again" : ": it stopped before its end"));
    if ((server.lost == 0 && server.stalls < stalls_needed) || !server.losses.is_news()) {
      return;
    }
    Finding finding{CauseId::segments_lost, node, 0, {}, {}, {}, {}, server.losses};
    finding.title = fmt::format("segments of SDO transfers with node {} are lost", node);
    finding.text = fmt::format(
        "{} segments of blocks were not confirmed, and {} transfers stopped before their end: "
        "one side does not receive all frames.",
        server.lost, server.stalls);
    finding.check = "error counters, cable and termination; bus load (lexican mon --rate); receive queue of the device";
    finding.fix = "the cause of the losses; until then shorter blocks, and transfers without block (sub-blocks of 16)";
    findings_.put(std::move(finding));
  }

  void report_toggle(std::uint8_t node, const SdoTransfer& transfer) {
    Server& server = servers_[node];
    const std::string object = facts_.object(node, transfer.index, transfer.sub_index);
    server.toggles.add(transfer.time, words(transfer, object) + ": the toggle bit does not alternate");
    Finding finding{CauseId::toggle_wrong, node, 0, {}, {}, {}, {}, server.toggles};
    finding.title = fmt::format("the toggle bit of SDO segments with node {} is wrong", node);
    finding.text = fmt::format(
        "It did not alternate in {} transfers: a segment was lost, came twice, or the firmware of "
        "one side is wrong.",
        server.toggles.count());
    finding.check = fmt::format("lexican read {} {:04X}:{:X}", node, transfer.index, transfer.sub_index);
    finding.fix = "the firmware of the side whose bit is wrong: 0 in the first segment, then in turn [301:7.2.4.3]";
    findings_.put(std::move(finding));
  }

  std::array<Server, 128> servers_{};
  std::map<Access, Refusal> refusals_;
};

}  // namespace

std::unique_ptr<Check> make_sdo_check(const Facts& facts, Findings& findings) {
  return std::make_unique<SdoCheck>(facts, findings);
}

}  // namespace lexican::explain
