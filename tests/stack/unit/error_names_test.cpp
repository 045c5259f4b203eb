// SPDX-License-Identifier: Apache-2.0
// COErrName(), COErrText(), CODictFaultName(), CODictFaultText(), CONodeGetErrText(). tests/stack/compat/error_codes.c
// compares all names and numbers of co_err.h with a separate list.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <string>

#include "support/fixture.hpp"
#include "support/plain_drivers.hpp"

namespace {

using namespace test;

constexpr unsigned last_error = 0x15F;
constexpr unsigned last_fault = 15;

// Checks that the text is one line that can follow the name of an error in a message.
void check_text(const std::string& text) {
  CAPTURE(text);
  CHECK(text.size() > 7);
  CHECK(text.size() < 110);
  CHECK(text.back() != '.');
  for (const char c : text) {
    CHECK((c >= ' ' && c <= '~'));
  }
}

TEST_CASE("error names: each error has a unique name and meaning") {
  std::set<std::string> names = {COErrName(CO_ERR_NONE)};
  CHECK(COErrName(CO_ERR_NONE) == std::string("CO_ERR_NONE"));
  CHECK(COErrText(CO_ERR_NONE) == std::string("no error"));
  for (unsigned number = CO_ERR_BASE; number <= last_error; ++number) {
    CAPTURE(number);
    const auto err = static_cast<CO_ERR>(number);
    const std::string name = COErrName(err);
    CHECK(name.rfind("CO_ERR_", 0) == 0);
    CHECK(names.insert(name).second);
    check_text(COErrText(err));
  }
  CHECK(COErrName(CO_ERR_BAD_ARG) == std::string("CO_ERR_BAD_ARG"));
  CHECK(COErrText(CO_ERR_BAD_ARG) == std::string("an argument is null, out of range or of the wrong length"));
  CHECK(COErrName(CO_ERR_NODE_SDO_BUF) == std::string("CO_ERR_NODE_SDO_BUF"));
  CHECK(COErrText(CO_ERR_OBJ_RANGE_LOW) == std::string("the value is too low (SDO abort 0609 0032h)"));
}

TEST_CASE("error names: undefined numbers are unknown") {
  for (const unsigned number : {1U, 0xFFU, last_error + 1, 0x1FFU}) {
    CAPTURE(number);
    CHECK(COErrName(static_cast<CO_ERR>(number)) == std::string("unknown error"));
    CHECK(COErrText(static_cast<CO_ERR>(number)) == std::string("unknown error"));
  }
}

TEST_CASE("error names: each fault of a dictionary has a name and a meaning") {
  std::set<std::string> names;
  for (unsigned number = 0; number <= last_fault; ++number) {
    CAPTURE(number);
    const auto fault = static_cast<CO_DICT_FAULT>(number);
    const std::string name = CODictFaultName(fault);
    CHECK(name.rfind("CO_DICT_", 0) == 0);
    CHECK(names.insert(name).second);
    check_text(CODictFaultText(fault));
  }
  CHECK(CODictFaultName(CO_DICT_OK) == std::string("CO_DICT_OK"));
  CHECK(CODictFaultText(CO_DICT_OK) == std::string("no fault"));
  CHECK(CODictFaultName(CO_DICT_NO_TYPE) == std::string("CO_DICT_NO_TYPE"));
  CHECK(CODictFaultName(CO_DICT_PARA_OVERLAP) == std::string("CO_DICT_PARA_OVERLAP"));
}

CO_ERR text_of(CO_NODE& node, std::string& text, std::uint32_t size = CO_NODE_ERR_TEXT) {
  char bytes[CO_NODE_ERR_TEXT + 1];
  std::memset(bytes, '#', sizeof bytes);
  const CO_ERR err = CONodeGetErrText(&node, bytes, size);
  CHECK(bytes[size] == '#');
  text = bytes;
  return err;
}

TEST_CASE("CONodeGetErrText: name, object and meaning of the last error, then no error") {
  Fixture node;
  std::string text;
  node->Error = CO_ERR_TPDO_MAP_OBJ;
  node->ErrorKey = CO_DEV(0x1A00, 0xB);
  CHECK(text_of(node.node, text) == CO_ERR_TPDO_MAP_OBJ);
  CHECK(text == std::string("CO_ERR_TPDO_MAP_OBJ, object 1A00h:0B: ") + COErrText(CO_ERR_TPDO_MAP_OBJ));
  CHECK(text_of(node.node, text) == CO_ERR_NONE);
  CHECK(text == "no error");
  node->Error = CO_ERR_IF_CAN_SEND;
  CHECK(text_of(node.node, text) == CO_ERR_IF_CAN_SEND);
  CHECK(text == std::string("CO_ERR_IF_CAN_SEND: ") + COErrText(CO_ERR_IF_CAN_SEND));
}

TEST_CASE("CONodeGetErrText: without an error the text names missing calls and settings") {
  std::string text;
  SUBCASE("CONodeStart()") {
    Fixture node(Setup().stay_in_init());
    CHECK(text_of(node.node, text) == CO_ERR_NONE);
    CHECK(text == "no error; CONodeStart() has not been called");
  }
  SUBCASE("the bit rate, after a look at the node in CO_INVALID") {
    Fixture node;
    node->Baudrate = 0;
    CHECK(text_of(node.node, text) == CO_ERR_NONE);
    CHECK(text == "no error; the bit rate is 0 (CO_NODE_SPEC.Baudrate)");
    const CO_MODE mode = node->Nmt.Mode;
    node->Nmt.Mode = CO_INVALID;
    CHECK(text_of(node.node, text) == CO_ERR_NONE);
    CHECK(text == "no error; stopped by CONodeStop() or an earlier error (CO_INVALID)");
    node->Nmt.Mode = mode;
  }
  SUBCASE("COTmrService() and COTmrProcess()") {
    Fixture node(Setup().heartbeat(100));
    node.idle(100ms);
    CHECK(text_of(node.node, text) == CO_ERR_NONE);
    CHECK(text == "no error");
    node.idle(126ms);
    CHECK(text_of(node.node, text) == CO_ERR_NONE);
    CHECK(text == "no error; a timer has elapsed, and COTmrService() has not been called since");
    COTmrService(&node->Tmr);
    CHECK(text_of(node.node, text) == CO_ERR_NONE);
    CHECK(text == "no error; a timer has elapsed, and COTmrProcess() has not been called since");
    COTmrProcess(&node->Tmr);
    node.tx("701#7F");
    CHECK(text_of(node.node, text) == CO_ERR_NONE);
    CHECK(text == "no error");
  }
  SUBCASE("COTmrService(), not for a timer far in the future") {
    Fixture node;
    CHECK(COTmrCreate(
              &node->Tmr, 0x90000000, 0, [](void*) {}, nullptr) >= 0);
    CHECK(text_of(node.node, text) == CO_ERR_NONE);
    CHECK(text == "no error");
  }
  SUBCASE("COTmrService(), for weeks") {
    Fixture node;
    CHECK(COTmrCreate(
              &node->Tmr, 10, 0, [](void*) {}, nullptr) >= 0);
    node.idle(2147484s);
    CHECK(text_of(node.node, text) == CO_ERR_NONE);
    CHECK(text == "no error; a timer has elapsed, and COTmrService() has not been called since");
  }
  SUBCASE("COTmrService(), with a classic driver") {
    PlainNode node(false);
    COTmrCreate(
        &node.node.Tmr, 10, 0, [](void*) {}, nullptr);
    plain_timer().left = 0;
    CHECK(text_of(node.node, text) == CO_ERR_NONE);
    CHECK(text.find("; a timer has elapsed, and COTmrService() has not been called since") != std::string::npos);
    COTmrService(&node.node.Tmr);
    CHECK(text_of(node.node, text) == CO_ERR_NONE);
    CHECK(text.find("timer") == std::string::npos);
  }
  SUBCASE("the heartbeat") {
    Fixture node(Setup().without(0x1017, 0));
    CHECK(text_of(node.node, text) == CO_ERR_NONE);
    CHECK(text == "no error; no heartbeat: the dictionary has no object 1017h");
  }
}

TEST_CASE("A heartbeat with the node's own node-ID is reported") {
  Fixture node(Setup().node_id(5));
  node.rx("706#05");
  CHECK(CONodeGetErr(&node.node) == CO_ERR_NONE);
  node.rx("705#00");
  CHECK(CONodeGetErr(&node.node) == CO_ERR_NODE_ID_TWICE);
  node.trace();  // EMCY 8150h, where there is EMCY
  CHECK(CONodeGetErr(&node.node) == CO_ERR_NONE);
}

TEST_CASE("CONodeGetErrText: entries in the wrong order are named in every configuration") {
  const std::string fault =
      std::string("CO_DICT_NOT_ASCENDING, object 2001h:00: ") + CODictFaultText(CO_DICT_NOT_ASCENDING);
  CO_OBJ table[] = {{CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 0},
                    {CO_KEY(0x2002, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 0},
                    {CO_KEY(0x2001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 0},
                    CO_OBJ_DICT_ENDMARK};
  Fixture node;
  std::string text;
  node->Error = CO_ERR_NONE;
  CHECK((CODictInit(&node->Dict, &node.node, table, 4) < 0) == (USE_DICT_CHECK != 0));
  if (USE_DICT_CHECK != 0) {
    node->Error = CO_ERR_DICT_INIT;
  }
  CHECK(text_of(node.node, text) == CO_ERR_DICT_INIT);
  CHECK(text.substr(text.size() - fault.size()) == fault);
}

TEST_CASE("CONodeGetErrText: a text that is too long is cut off; the longest one fits") {
  Fixture node;
  std::string text;
  node->Error = CO_ERR_IF_CAN_SEND;
  CHECK(text_of(node.node, text, 7) == CO_ERR_IF_CAN_SEND);
  CHECK(text == "CO_ERR");
  node->Error = CO_ERR_IF_CAN_SEND;
  CHECK(text_of(node.node, text, 1) == CO_ERR_IF_CAN_SEND);
  CHECK(text.empty());
  char letter = 'x';
  CHECK(CONodeGetErrText(nullptr, &letter, 1) == CO_ERR_BAD_ARG);
  CHECK(CONodeGetErrText(&node.node, nullptr, 1) == CO_ERR_BAD_ARG);
  CHECK(CONodeGetErrText(&node.node, &letter, 0) == CO_ERR_BAD_ARG);
  CHECK(letter == 'x');
  std::size_t longest_error = 0;
  for (unsigned number = CO_ERR_BASE; number <= last_error; ++number) {
    const auto err = static_cast<CO_ERR>(number);
    longest_error = std::max(longest_error, std::strlen(COErrName(err)) + std::strlen(COErrText(err)));
  }
  std::size_t longest_fault = 0;
  for (unsigned number = 0; number <= last_fault; ++number) {
    const auto fault = static_cast<CO_DICT_FAULT>(number);
    longest_fault = std::max(longest_fault, std::strlen(CODictFaultName(fault)) + std::strlen(CODictFaultText(fault)));
  }
  CHECK(longest_error + longest_fault + 2 * std::strlen(", object 1A00h:0B: ") + std::strlen("; dictionary: ") <
        CO_NODE_ERR_TEXT);
}

// The numbers must not change, because firmware logs them.
static_assert(CO_DICT_NOT_ASCENDING == 1 && CO_DICT_NO_DATA == 3 && CO_DICT_WRONG_PLACE == 6);
static_assert(CO_DICT_DIRECT_CONST == 9 && CO_DICT_PARA_OVERLAP == 12 && CO_DICT_MAP_LENGTH == last_fault);
static_assert(CO_ERR_OBJ_RANGE_LOW == 0x15C && CO_ERR_DICT_BUSY == last_error);

}  // namespace
