// SPDX-License-Identifier: Apache-2.0
// Entries of basic types whose Data is null: accesses to them are refused, and the node works otherwise.
#include <iterator>

#include "support/fixture.hpp"
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

struct Null {
  std::uint16_t index;
  std::uint8_t sub;
  const CO_OBJ_TYPE* type;
};

CO_OBJ entry_of(const Null& null, std::uint32_t flags = CO_OBJ_____RW) {
  return {CO_KEY(null.index, null.sub, flags), null.type, 0};
}

// Types that are allowed at any index.
const Null basic[] = {
    {0x4000, 0, CO_TUNSIGNED8},    {0x4001, 0, CO_TUNSIGNED16},     {0x4002, 0, CO_TUNSIGNED32},
    {0x4003, 0, CO_TUNSIGNED64},   {0x4004, 0, CO_TUNSIGNED24},     {0x4005, 0, CO_TUNSIGNED40},
    {0x4006, 0, CO_TUNSIGNED48},   {0x4007, 0, CO_TUNSIGNED56},     {0x4008, 0, CO_TSIGNED24},
    {0x4009, 0, CO_TSIGNED40},     {0x400A, 0, CO_TSIGNED48},       {0x400B, 0, CO_TSIGNED56},
    {0x400C, 0, CO_TBOOLEAN},      {0x400D, 0, CO_TREAL32},         {0x400E, 0, CO_TREAL64},
    {0x400F, 0, CO_TTIME_OF_DAY},  {0x4010, 0, CO_TDOMAIN},         {0x4011, 0, CO_TVISIBLE_STRING},
    {0x4012, 0, CO_TOCTET_STRING}, {0x4013, 0, CO_TUNICODE_STRING},
#if USE_OD
    {0x4020, 0, OD_TUNSIGNED32},   {0x4021, 0, OD_TDOMAIN},         {0x4022, 0, OD_TVISIBLE_STRING},
#endif
};

// Types that are allowed only at their index of the communication profile.
const Null placed[] = {
    {0x1014, 0, CO_TEMCY_ID},       {0x1017, 0, CO_THB_PROD},      {0x1029, 1, CO_TERROR_BEHAVIOUR},
    {0x1F80, 0, CO_TNMT_STARTUP},
#if CO_SSDO_N > 1
    {0x1201, 1, CO_TSDO_ID},        {0x1201, 2, CO_TSDO_ID},
#endif
#if CO_HBCONS_N > 0
    {0x1016, 0, CO_THB_CONS},       {0x1016, 1, CO_THB_CONS},
#endif
#if USE_SYNC
    {0x1005, 0, CO_TSYNC_ID},       {0x1006, 0, CO_TSYNC_CYCLE},   {0x1007, 0, CO_TSYNC_CYCLE},
    {0x1019, 0, CO_TSYNC_COUNT},
#endif
#if USE_PARA
    {0x1010, 1, CO_TPARA_STORE},    {0x1011, 1, CO_TPARA_RESTORE}, {0x1020, 1, CO_TVERIFY_CONFIG},
#endif
#if USE_TIME
    {0x1012, 0, CO_TTIME_ID},
#if USE_TIME_HIGH_RES
    {0x1013, 0, CO_TTIME_HIGH_RES},
#endif
#endif
#if CO_EMCY_CONS_N > 0
    {0x1028, 1, CO_TEMCY_CONS},
#endif
#if CO_RPDO_N > 0
    {0x1400, 1, CO_TPDO_ID},        {0x1400, 2, CO_TPDO_TYPE},     {0x1400, 5, CO_TPDO_EVENT},
    {0x1600, 0, CO_TPDO_NUM},       {0x1600, 1, CO_TPDO_MAP},
#endif
#if CO_TPDO_N > 0
    {0x1800, 1, CO_TPDO_ID},        {0x1800, 2, CO_TPDO_TYPE},     {0x1800, 3, CO_TPDO_INHIBIT},
    {0x1800, 5, CO_TPDO_EVENT},     {0x1800, 6, CO_TPDO_START},    {0x1A00, 0, CO_TPDO_NUM},
    {0x1A00, 1, CO_TPDO_MAP},
#endif
#if USE_RECORDER
    {0x2301, 1, CO_TREC_CONFIG},    {0x2301, 10, CO_TREC_CONFIG},  {0x2400, 0, CO_TREC_ENABLE},
    {0x2401, 1, CO_TREC_DATA},      {0x2401, 6, CO_TREC_DATA},
#endif
#if CO_MPDO_N > 0
    {0x1FA0, 1, CO_TPDO_SCAN},      {0x1FD0, 1, CO_TPDO_DISPATCH},
#endif
};

std::string multiplexer(const Null& null) {
  CO_IF_FRM frm = frame("601#0000000000000000");
  CO_SET_WORD(&frm, null.index, 0);
  CO_SET_BYTE(&frm, null.sub, 2);
  return notation(frm).substr(4, 6);
}

// Checks that every initiate is aborted with 0800 0020h.
void check_refused(Fixture& node, const Null& null) {
  CAPTURE(null.index);
  CAPTURE(unsigned{null.sub});
  const std::string object = multiplexer(null);
  const std::string refused = "581#80" + object + "20000008";
  for (const char* const command : {"40", "22", "23", "27", "2B", "2F", "20", "21"}) {
    CAPTURE(command);
    node.ask("601#" + std::string(command) + object + "01000000", refused);
  }
#if USE_SDO_BLOCK
  node.ask("601#A4" + object + "7F000000", refused);
  node.ask("601#C4" + object + "00000000", refused);
  node.ask("601#C6" + object + "04000000", refused);
#endif
}

void check_errors(Fixture& node, const Null& null) {
  CAPTURE(null.index);
  CAPTURE(unsigned{null.sub});
  const std::uint32_t key = CO_DEV(null.index, null.sub);
  CO_OBJ* const obj = node.find(null.index, null.sub);
  node.call([&] {
    CO_DICT* const dict = &node->Dict;
    std::uint8_t bytes[16] = {};
    std::uint16_t word = 0;
    std::uint32_t number = 0;
    CHECK(CODictRdByte(dict, key, bytes) != CO_ERR_NONE);
    CHECK(CODictRdWord(dict, key, &word) != CO_ERR_NONE);
    CHECK(CODictRdLong(dict, key, &number) != CO_ERR_NONE);
    CHECK(CODictWrByte(dict, key, 1) != CO_ERR_NONE);
    CHECK(CODictWrWord(dict, key, 1) != CO_ERR_NONE);
    CHECK(CODictWrLong(dict, key, 1) != CO_ERR_NONE);
    for (std::uint8_t size = 0; size <= 16; ++size) {
      CHECK(CODictRdBuffer(dict, key, bytes, size) != CO_ERR_NONE);
      CHECK(CODictWrBuffer(dict, key, bytes, size) != CO_ERR_NONE);
      CHECK(COObjRdBufCont(obj, &node.node, bytes, size) != CO_ERR_NONE);
      CHECK(COObjWrBufCont(obj, &node.node, bytes, size) != CO_ERR_NONE);
    }
    CHECK(COObjGetSize(obj, &node.node, 0) == 0);
    (void)COObjReset(obj, &node.node, 0);
    (void)COObjInit(obj, &node.node);
  });
}

// Sends frames of every service.
void run(Fixture& node) {
  for (const char* const text : {"000#0101", "080#", "080#01", "100#010203040506", "201#0102030405060708", "705#05",
                                 "085#0010810000000000", "181#R8", "701#R1", "000#8201", "000#0101"}) {
    node.rx(text);
    node.after(20ms);
    node.frames();
  }
  node.rx("000#8101");
  node.after(20ms);
  node.frames();
}

TEST_CASE(
    "null Data: a basic type refuses every transfer with 0800 0020h and every call with an error; the node runs") {
  for (const Null& null : basic) {
    Fixture node(Setup().only_small().with(entry_of(null)));
    CHECK(node.mode() == CO_PREOP);
    check_refused(node, null);
    check_errors(node, null);
    node.ask("601#4004200000000000", "581#4304200011223344");
    run(node);
    CHECK(node.mode() == CO_PREOP);
    check_refused(node, null);
  }
}

TEST_CASE("null Data: a read-only text refuses uploads with 0800 0020h") {
  Fixture node(Setup().only_small().with({CO_KEY(0x4000, 0, CO_OBJ_____R_), CO_TSTRING, 0}));
  node.ask("601#4000400000000000", "581#8000400020000008");
  node.ask("601#2300400001020304", "581#8000400002000106");
}

TEST_CASE("null Data: a communication object refuses every transfer with 0800 0020h; the node runs") {
  for (const Null& null : placed) {
    CAPTURE(null.index);
    CAPTURE(unsigned{null.sub});
    Fixture node(Setup().only_small().with(entry_of(null)));
    CHECK(node.mode() == CO_PREOP);
    check_refused(node, null);
    check_errors(node, null);
    run(node);
    CHECK(node.mode() == CO_PREOP);
    check_refused(node, null);
  }
}

TEST_CASE("null Data: all communication objects at once do not stop the node") {
  Setup setup;
  setup.only_small();
  for (const Null& null : placed) {
    setup.with(entry_of(null));
  }
  Fixture node(setup);
  run(node);
  for (const Null& null : placed) {
    check_refused(node, null);
  }
}

#if USE_EMCY
TEST_CASE("null Data: an entry of 1003h refuses every transfer with 0800 0020h and limits the history") {
  static std::uint32_t first;
  static std::uint8_t number;
  Setup setup = Setup().only_small().emergencies({{CO_EMCY_REG_GENERAL, 0x1000}});
  setup.with({CO_KEY(0x1003, 0, CO_OBJ_____RW), CO_TEMCY_HIST, &number});
  setup.with({CO_KEY(0x1003, 1, CO_OBJ_____R_), CO_TEMCY_HIST, &first});
  setup.with({CO_KEY(0x1003, 2, CO_OBJ_____R_), CO_TEMCY_HIST, 0});
  Fixture node(setup);
  for (int i = 0; i < 3; ++i) {
    node.call([&] { COEmcySet(&node->Emcy, 0, nullptr); });
    node.call([&] { COEmcyClr(&node->Emcy, 0); });
  }
  node.frames();
  node.ask("601#4003100000000000", "581#4F03100001000000");
  node.ask("601#4003100100000000", "581#4303100100100000");
  node.ask("601#4003100200000000", "581#8003100220000008");
}
#endif

#if USE_DICT_CHECK

TEST_CASE("null Data: CODictGetFault() returns the first entry, and the node error is CO_ERR_OBJ_INIT") {
  for (const Null& null : basic) {
    CAPTURE(null.index);
    Fixture node(Setup().only_small().with(entry_of(null)).with({CO_KEY(0x4FFF, 0, CO_OBJ_____RW), CO_TUNSIGNED8, 0}));
    CHECK(node.error() == CO_ERR_OBJ_INIT);
    std::uint32_t key = 0;
    CHECK(CODictGetFault(&node->Dict, &key) == CO_DICT_NO_DATA);
    CHECK(CO_GET_DEV(key) == CO_DEV(null.index, null.sub));
  }
}

TEST_CASE("dictionary: flag N without meaning, or data of a static data type, is reported; the node runs") {
  static std::uint32_t variable;
  const struct {
    CO_OBJ entry;
    CO_DICT_FAULT fault;
  } rows[] = {
      {{CO_KEY(0x4000, 0, CO_OBJ__N__RW), CO_TREAL32, &variable}, CO_DICT_NODEID_TYPE},
      {{CO_KEY(0x4000, 0, CO_OBJ__N__RW), CO_TBOOLEAN, &variable}, CO_DICT_NODEID_TYPE},
      {{CO_KEY(0x0007, 0, CO_OBJ_____R_), CO_TUNSIGNED32, &variable}, CO_DICT_RESERVED_INDEX},
  };
  for (const auto& row : rows) {
    CAPTURE(row.entry.Key);
    Fixture node(Setup().only_small().with(row.entry));
    CHECK(node.mode() == CO_PREOP);
    CHECK(node.error() == CO_ERR_OBJ_INIT);
    std::uint32_t key = 0;
    CHECK(CODictGetFault(&node->Dict, &key) == row.fault);
    CHECK(key == row.entry.Key);
    node.ask("601#4004200000000000", "581#4304200011223344");
  }
}

TEST_CASE("dictionary: a fault that stops the node is reported before one that does not") {
  static std::uint32_t variable;
  Setup setup;
  setup.with({CO_KEY(0x4000, 0, CO_OBJ_____RW), CO_TUNSIGNED8, 0});
  setup.with({CO_KEY(0x4001, 0, CO_OBJ_____RW), CO_THB_PROD, &variable});
  setup.with({CO_KEY(0x4002, 0, CO_OBJ_____RW), CO_TUNSIGNED8, 0});
  setup.with({CO_KEY(0x4003, 0, CO_OBJ_D___RW), CO_TDOMAIN, 1});
  Fixture node(setup.stay_in_init());
  CHECK(node.mode() == CO_INVALID);
  CHECK(node.error() == CO_ERR_DICT_INIT);
  std::uint32_t key = 0;
  CHECK(CODictGetFault(&node->Dict, &key) == CO_DICT_WRONG_PLACE);
  CHECK(CO_GET_DEV(key) == CO_DEV(0x4001, 0));
}

#endif

#if CO_RPDO_N > 1 && CO_TPDO_N > 1
TEST_CASE("null Data: a PDO that maps the entry does not exist; other PDOs do") {
  for (const CO_OBJ_TYPE* const type : {CO_TUNSIGNED8, CO_TBOOLEAN, CO_TVISIBLE_STRING, CO_TDOMAIN}) {
    PdoTable table;
    table.rpdo[0].on(0x201, 255, {0x40000008});
    table.rpdo[1].on(0x301, 255, {0x22010108});
    table.tpdo[0].on(0x181, 255, {0x40000008});
    table.tpdo[1].on(0x281, 255, {0x22010208});
    PdoNode node(table, [&](Setup& setup) { setup.with({CO_KEY(0x4000, 0, CO_OBJ____PRW), type, 0}); });
    node.start();
    node.rx("201#55");
    node.silent();
    node.rx("301#55");
    CHECK(node.u8[0] == 0x55);
    CHECK(node.request(0) == CO_ERR_TPDO_COM_OBJ);
    CHECK(node.request(1) == CO_ERR_NONE);
    node.tx("281#21");
    CHECK(node.remap_rpdo(0, {0x40000008}, 0x201) == 0x06040041);
  }
}
#endif

}  // namespace
