// SPDX-License-Identifier: Apache-2.0
/// \file lss_master_fixture.hpp
/// A node that is LSS master, and the results of its services:
///
///     LssMaster node;
///     node.run("7E5#5E00000000000000", COLssmInquireNodeId);      // starts the service and expects the request
///     node.rx("7E4#5E05000000000000");
///     CHECK(node.end(CO_LSSM_OK).value == 5);                     // result of the service
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fixture.hpp"

#if USE_LSS_MASTER

namespace test {

using LssNumbers = std::array<std::uint32_t, 4>;

/// Arguments of the callback at the end of a service.
struct LssEnd {
  CO_LSSM_RESULT result;
  std::uint32_t value;
  std::uint8_t error;
  std::uint8_t specific;
  LssNumbers address;
};

inline std::vector<LssEnd> lss_ends;
inline std::function<void(CO_LSSM*)> lss_next;  ///< called by the callback
inline unsigned lss_depth = 0;                  ///< nesting depth of callbacks

inline void note_lss(CO_LSSM* lssm, CO_LSSM_RESULT result) {
  CHECK(lss_depth == 0);
  ++lss_depth;
  const OutsideStack outside;
  lss_ends.push_back({result,
                      lssm->Value,
                      lssm->Error,
                      lssm->Specific,
                      {lssm->Address[0], lssm->Address[1], lssm->Address[2], lssm->Address[3]}});
  if (lss_next) {
    lss_next(lssm);
  }
  --lss_depth;
}

inline constexpr std::uint8_t lss_waiting = CO_LSSM_WAITING;
inline constexpr std::uint8_t lss_configuration = CO_LSSM_CONFIGURATION;
inline constexpr std::uint32_t lss_address[4] = {0x00000319, 0x12345678, 0x00010002, 0x00000044};
inline constexpr std::uint32_t lss_range[6] = {0x00000319, 0x12345678, 1, 0x00020000, 0x40, 0xFFFFFFFF};

class LssMaster : public Fixture {
 public:
  explicit LssMaster(Setup setup = {}) : Fixture(setup.only_small()) {
    lss_ends.clear();
    lss_next = nullptr;
  }
  ~LssMaster() { lss_next = nullptr; }
  LssMaster(const LssMaster&) = delete;
  LssMaster& operator=(const LssMaster&) = delete;

  template <class... Argument, class... Given>
  CO_ERR start(CO_ERR (*service)(CO_LSSM*, Argument...), Given... given) {
    CO_ERR err = CO_ERR_NONE;
    call([&] { err = service(&node.Lssm, given..., note_lss); });
    return err;
  }
  /// Starts a service and checks its request.
  template <class... Argument, class... Given>
  void run(const char* request, CO_ERR (*service)(CO_LSSM*, Argument...), Given... given) {
    REQUIRE(start(service, given...) == CO_ERR_NONE);
    tx(request);
  }
  void times(std::uint32_t timeout, std::uint32_t listen) {
    call([&] { CHECK(COLssmSetTimes(&node.Lssm, timeout, listen) == CO_ERR_NONE); });
  }
  void cancel() {
    call([&] { CHECK(COLssmCancel(&node.Lssm) == CO_ERR_NONE); });
  }
  /// Returns the result of the only service that has ended since the last check.
  LssEnd end(CO_LSSM_RESULT result, Where at = {__builtin_FILE(), __builtin_LINE()}) {
    if (lss_ends.size() != 1 || lss_ends[0].result != result) {
      ADD_FAIL_CHECK_AT(at.file, at.line,
                        lss_ends.size() << " ends, the first with " << (lss_ends.empty() ? 0 : lss_ends[0].result));
    }
    const LssEnd first = lss_ends.empty() ? LssEnd{} : lss_ends[0];
    lss_ends.clear();
    return first;
  }
  void goes_on(Where at = {__builtin_FILE(), __builtin_LINE()}) {
    if (!lss_ends.empty()) {
      ADD_FAIL_CHECK_AT(at.file, at.line, "ended with " << lss_ends[0].result);
    }
  }
};

/// A service with the answer of one slave.
struct LssDialogue {
  const char* name;
  std::function<CO_ERR(CO_LSSM*)> start;
  std::vector<std::string> requests;
  std::string answer;
};

inline const std::vector<LssDialogue>& lss_dialogues() {
  static const std::vector<LssDialogue> all = {
      {"switch selective",
       [](CO_LSSM* lssm) { return COLssmSwitchSelective(lssm, lss_address, note_lss); },
       {"7E5#4019030000000000", "7E5#4178563412000000", "7E5#4202000100000000", "7E5#4344000000000000"},
       "7E4#4400000000000000"},
      {"configure node-ID",
       [](CO_LSSM* lssm) { return COLssmConfigureNodeId(lssm, 0x20, note_lss); },
       {"7E5#1120000000000000"},
       "7E4#1100000000000000"},
      {"configure bit timing",
       [](CO_LSSM* lssm) { return COLssmConfigureBitTiming(lssm, 125000, note_lss); },
       {"7E5#1300040000000000"},
       "7E4#1300000000000000"},
      {"store",
       [](CO_LSSM* lssm) { return COLssmStore(lssm, note_lss); },
       {"7E5#1700000000000000"},
       "7E4#1700000000000000"},
      {"inquire vendor-ID",
       [](CO_LSSM* lssm) { return COLssmInquire(lssm, CO_LSSM_VENDOR, note_lss); },
       {"7E5#5A00000000000000"},
       "7E4#5A19030000000000"},
      {"inquire product code",
       [](CO_LSSM* lssm) { return COLssmInquire(lssm, CO_LSSM_PRODUCT, note_lss); },
       {"7E5#5B00000000000000"},
       "7E4#5B78563412000000"},
      {"inquire revision number",
       [](CO_LSSM* lssm) { return COLssmInquire(lssm, CO_LSSM_REVISION, note_lss); },
       {"7E5#5C00000000000000"},
       "7E4#5CFFFFFFFF000000"},
      {"inquire serial number",
       [](CO_LSSM* lssm) { return COLssmInquire(lssm, CO_LSSM_SERIAL, note_lss); },
       {"7E5#5D00000000000000"},
       "7E4#5D44000000000000"},
      {"inquire node-ID",
       [](CO_LSSM* lssm) { return COLssmInquireNodeId(lssm, note_lss); },
       {"7E5#5E00000000000000"},
       "7E4#5EFF000000000000"},
  };
  return all;
}

/// A service to which any slave may answer.
inline const std::vector<LssDialogue>& lss_searches() {
  static const std::vector<LssDialogue> all = {
      {"identify",
       [](CO_LSSM* lssm) { return COLssmIdentify(lssm, lss_range, note_lss); },
       {"7E5#4619030000000000", "7E5#4778563412000000", "7E5#4801000000000000", "7E5#4900000200000000",
        "7E5#4A40000000000000", "7E5#4BFFFFFFFF000000"},
       "7E4#4F00000000000000"},
      {"identify non-configured",
       [](CO_LSSM* lssm) { return COLssmIdentifyUnconfigured(lssm, note_lss); },
       {"7E5#4C00000000000000"},
       "7E4#5000000000000000"},
  };
  return all;
}

inline void start(LssMaster& node, const LssDialogue& dialogue) {
  node.call([&] { REQUIRE(dialogue.start(&node->Lssm) == CO_ERR_NONE); });
}

inline void start_all(LssMaster& node, const LssDialogue& dialogue) {
  start(node, dialogue);
  for (std::size_t n = 0; n < dialogue.requests.size(); ++n) {
    if (n > 0) {
      node.silent();
      node.after(1ms);
    }
    node.tx(dialogue.requests[n]);
  }
}

}  // namespace test

#endif
