// SPDX-License-Identifier: Apache-2.0
#include "pdo_fixture.hpp"

#include <type_traits>

namespace test {

PdoEntries& PdoEntries::on(std::uint32_t cob_id_value, std::uint8_t type_value,
                           std::initializer_list<std::uint32_t> words) {
  cob_id = cob_id_value;
  type = type_value;
  number = static_cast<std::uint8_t>(words.size());
  std::copy(words.begin(), words.end(), map.begin());
  return *this;
}

PdoTable::PdoTable() {
  for (unsigned n = 0; n < 4; ++n) {
    rpdo[n].cob_id = 0x80000201U + n * 0x100U;
    tpdo[n].cob_id = 0xC0000181U + n * 0x100U;
  }
}

namespace {

/// Returns the initial value of sub-index \a sub: byte k is 16 sub + k + 1.
std::uint64_t pattern(unsigned sub, unsigned bytes) {
  std::uint64_t value = 0;
  for (unsigned k = 0; k < bytes; ++k) {
    value |= std::uint64_t{16U * sub + k + 1U} << (8U * k);
  }
  return value;
}

template <class T>
void fill(T (&variables)[8], unsigned bytes = sizeof(T)) {
  for (unsigned s = 1; s <= 8; ++s) {
    variables[s - 1] = static_cast<T>(pattern(s, bytes));
  }
}

template <class... T>
void fill_single(T&... variable) {
  ((variable = static_cast<T>(pattern(1, sizeof(T)))), ...);
}

void add(Setup& setup, std::uint16_t index, std::uint8_t sub, std::uint32_t flags, const CO_OBJ_TYPE* type,
         CO_DATA data) {
  setup.with({CO_KEY(index, sub, flags), type, data});
}

template <class T>
void add_array(Setup& setup, std::uint16_t index, std::uint32_t flags, const CO_OBJ_TYPE* type, T (&variables)[8]) {
  add(setup, index, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 8);
  for (std::uint8_t s = 1; s <= 8; ++s) {
    add(setup, index, s, flags, type, &variables[s - 1]);
  }
}

/// Adds entries of 1, 2, 4 and 8 bytes at \a index + width, sub-index 1.
template <class T8, class T16, class T32, class T64>
void add_widths(Setup& setup, std::uint16_t index, std::uint32_t flags, T8& v8, T16& v16, T32& v32, T64& v64) {
  const auto at = [&](unsigned width) { return static_cast<std::uint16_t>(index + width); };
  add(setup, at(1), 1, flags, CO_TUNSIGNED8, &v8);
  add(setup, at(2), 1, flags, CO_TUNSIGNED16, &v16);
  add(setup, at(4), 1, flags, CO_TUNSIGNED32, &v32);
  add(setup, at(8), 1, flags, CO_TUNSIGNED64, &v64);
}

void add_variables(Setup& setup, PdoVariables& v) {
  add_array(setup, 0x2201, CO_OBJ____PRW, CO_TUNSIGNED8, v.u8);
  add_array(setup, 0x2202, CO_OBJ____PRW, CO_TUNSIGNED16, v.u16);
  add_array(setup, 0x2203, CO_OBJ____PRW, CO_TUNSIGNED24, v.u24);
  add_array(setup, 0x2204, CO_OBJ____PRW, CO_TUNSIGNED32, v.u32);
  add_array(setup, 0x2205, CO_OBJ____PRW, CO_TUNSIGNED40, v.u40);
  add_array(setup, 0x2206, CO_OBJ____PRW, CO_TUNSIGNED48, v.u48);
  add_array(setup, 0x2207, CO_OBJ____PRW, CO_TUNSIGNED56, v.u56);
  add_array(setup, 0x2208, CO_OBJ____PRW, CO_TUNSIGNED64, v.u64);
  add_array(setup, 0x2211, CO_OBJ___APRW, CO_TUNSIGNED8, v.a8);
  add_array(setup, 0x2212, CO_OBJ___APRW, CO_TUNSIGNED16, v.a16);
  add_array(setup, 0x2214, CO_OBJ___APRW, CO_TUNSIGNED32, v.a32);
  add_widths(setup, 0x2220, CO_OBJ____PR_, v.r8, v.r16, v.r32, v.r64);
  add_widths(setup, 0x2230, CO_OBJ____P_W, v.w8, v.w16, v.w32, v.w64);
  add_widths(setup, 0x2240, CO_OBJ_____RW, v.n8, v.n16, v.n32, v.n64);
  add_array(setup, 0x2250, CO_OBJ____PRW, CO_TBOOLEAN, v.boolean);
  add_array(setup, 0x2254, CO_OBJ____PRW, CO_TREAL32, v.real32);
  add_array(setup, 0x2258, CO_OBJ____PRW, CO_TREAL64, v.real64);
}

void add_communication(Setup& setup, std::uint16_t index, PdoEntries& pdo, bool is_tpdo) {
  add(setup, index, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, is_tpdo ? 6 : 5);
  add(setup, index, 1, CO_OBJ_____RW, CO_TPDO_ID, &pdo.cob_id);
  add(setup, index, 2, CO_OBJ_____RW, CO_TPDO_TYPE, &pdo.type);
  add(setup, index, 3, CO_OBJ_____RW, CO_TPDO_INHIBIT, &pdo.inhibit);
  add(setup, index, 5, CO_OBJ_____RW, CO_TPDO_EVENT, &pdo.event);
  if (is_tpdo) {
    add(setup, index, 6, CO_OBJ_____RW, CO_TPDO_START, &pdo.start);
  }
}

void add_mapping(Setup& setup, std::uint16_t index, PdoEntries& pdo) {
  add(setup, index, 0, CO_OBJ_____RW, CO_TPDO_NUM, &pdo.number);
  std::uint8_t sub = 1;
  for (std::uint32_t& word : pdo.map) {
    add(setup, index, sub++, CO_OBJ_____RW, CO_TPDO_MAP, &word);
  }
}

constexpr std::uint16_t plus(std::uint16_t index, unsigned n) { return static_cast<std::uint16_t>(index + n); }

}  // namespace

PdoVariables::PdoVariables() {
  fill(u8);
  fill(a8);
  fill(u16);
  fill(a16);
  fill(u24, 3);
  fill(u32);
  fill(a32);
  fill(u40, 5);
  fill(u48, 6);
  fill(u56, 7);
  fill(u64);
  fill_single(r8, w8, n8, r16, w16, n16, r32, w32, n32, r64, w64, n64);
  std::fill_n(real32, 8, 1.0F);
  std::fill_n(real64, 8, 1.0);
}

Setup PdoNode::setup(const std::function<void(Setup&)>& change) {
  Setup setup;
  setup.only_small();
  add_variables(setup, *this);
  for (unsigned n = 0; n < fixture_rpdos; ++n) {
    add_communication(setup, plus(0x1400, n), rpdo[n], false);
    add_mapping(setup, plus(0x1600, n), rpdo[n]);
  }
  for (unsigned n = 0; n < fixture_tpdos; ++n) {
    add_communication(setup, plus(0x1800, n), tpdo[n], true);
    add_mapping(setup, plus(0x1A00, n), tpdo[n]);
  }
  if (change) {
    change(setup);
  }
  return setup;
}

PdoNode::PdoNode(const PdoTable& table, const std::function<void(Setup&)>& change)
    : PdoTable(table), Fixture(setup(change)) {
  frames_per_call(1 + fixture_tpdos);  // A SYNC transmits all TPDOs.
  for (unsigned index = 0x2201; index <= 0x2258; ++index) {
    const bool is_read_only = index >= 0x2220 && index <= 0x222F;
    for (unsigned sub = 1; sub <= 8 && !is_read_only; ++sub) {
      may_change(static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub));  // RPDOs may write it
    }
  }
  for (const std::uint16_t index : {std::uint16_t{0x2001}, std::uint16_t{0x2002}, std::uint16_t{0x2004}}) {
    may_change(index, 0);
  }
  watch_parameters();
}

// Adds the PDO parameters to the invariants, without sub-index 0 of the mapping: a refused number sets it to 0.
void PdoNode::watch_parameters() {
  const auto watch_pdo = [this](std::uint16_t communication, std::uint16_t mapping, const PdoEntries& pdo) {
    watch(communication, 1, &pdo.cob_id, sizeof pdo.cob_id);
    watch(communication, 2, &pdo.type, sizeof pdo.type);
    watch(communication, 3, &pdo.inhibit, sizeof pdo.inhibit);
    watch(communication, 5, &pdo.event, sizeof pdo.event);
    watch(communication, 6, &pdo.start, sizeof pdo.start);
    for (std::uint8_t s = 1; s <= pdo.map.size(); ++s) {
      watch(mapping, s, &pdo.map[s - 1U], sizeof pdo.map[0]);
    }
  };
  for (unsigned n = 0; n < 4; ++n) {
    watch_pdo(plus(0x1400, n), plus(0x1600, n), rpdo[n]);
    watch_pdo(plus(0x1800, n), plus(0x1A00, n), tpdo[n]);
  }
}

void PdoNode::start(Where at) {
  rx("000#0101", at);
  silent(at);
}

std::uint32_t PdoNode::set(std::uint16_t index, std::uint8_t sub, unsigned bytes, std::uint64_t value, Where at) {
  Bytes data(bytes);
  for (std::uint8_t& byte : data) {
    byte = static_cast<std::uint8_t>(value);
    value >>= 8;
  }
  if (bytes > 4) {
    return download(index, sub, data, true, at);
  }
  CO_IF_FRM frm{};
  CO_SET_ID(&frm, 0x601);
  CO_SET_DLC(&frm, 8);
  CO_SET_BYTE(&frm, 0x23U | ((4U - bytes) << 2), 0);
  CO_SET_WORD(&frm, index, 1);
  CO_SET_BYTE(&frm, sub, 3);
  std::copy(data.begin(), data.end(), frm.Data + 4);
  rx(frm, at);
  const auto is_answer = [](const Sent& sent) { return sent.frm.Identifier == 0x581; };
  const auto found = std::find_if(can.sent.begin(), can.sent.end(), is_answer);  // skips PDOs
  if (found == can.sent.end() || (found->frm.Data[0] != 0x60 && found->frm.Data[0] != 0x80)) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "no answer to a download");
    return 0xFFFFFFFF;
  }
  const CO_IF_FRM answer = found->frm;
  can.sent.erase(found);
  return answer.Data[0] == 0x60 ? 0 : CO_GET_LONG(&answer, 4);
}

std::uint64_t PdoNode::get(std::uint16_t index, std::uint8_t sub, Where at) {
  const Bytes data = upload(index, sub, at);
  if (data.empty() || data.size() > 8) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "no upload of 1 to 8 bytes");
  }
  std::uint64_t value = 0;
  std::for_each(data.rbegin(), data.rend(), [&](std::uint8_t byte) { value = value << 8 | byte; });
  return value;
}

void PdoNode::trigger(std::uint16_t number, Where at) {
  call([&] { COTPdoTrigPdo(node.TPdo, number); }, at);
}

CO_ERR PdoNode::request(std::uint16_t number, Where at) {
  CO_ERR err = CO_ERR_NONE;
  call([&] { err = COTPdoRequest(&node, number); }, at);
  return err;
}

std::uint32_t PdoNode::remap(std::uint16_t communication, std::uint16_t mapping,
                             const std::vector<std::uint32_t>& words, std::uint32_t cob_id, Where at) {
  std::uint32_t abort = set(communication, 1, 4, cob_id | 0x80000000U, at);
  abort = abort != 0 ? abort : set(mapping, 0, 1, 0, at);
  std::uint8_t sub = 1;
  for (const std::uint32_t word : words) {
    abort = abort != 0 ? abort : set(mapping, sub++, 4, word, at);
  }
  abort = abort != 0 ? abort : set(mapping, 0, 1, words.size(), at);
  return abort != 0 ? abort : set(communication, 1, 4, cob_id, at);
}

std::uint32_t PdoNode::remap_rpdo(unsigned n, const std::vector<std::uint32_t>& words, std::uint32_t cob_id, Where at) {
  return remap(plus(0x1400, n), plus(0x1600, n), words, cob_id, at);
}

std::uint32_t PdoNode::remap_tpdo(unsigned n, const std::vector<std::uint32_t>& words, std::uint32_t cob_id, Where at) {
  return remap(plus(0x1800, n), plus(0x1A00, n), words, cob_id, at);
}

}  // namespace test
