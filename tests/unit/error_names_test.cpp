// SPDX-License-Identifier: Apache-2.0
// COErrName(), COErrText(), CODictFaultName(), CODictFaultText(). tests/compat/error_codes.c compares all names and
// numbers of co_err.h with a separate list.
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "co_core.h"

namespace {

constexpr unsigned last_error = 0x15D;
constexpr unsigned last_fault = 12;

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
  for (const unsigned number : {last_fault + 1, 15U}) {
    CHECK(CODictFaultName(static_cast<CO_DICT_FAULT>(number)) == std::string("unknown fault"));
    CHECK(CODictFaultText(static_cast<CO_DICT_FAULT>(number)) == std::string("unknown fault"));
  }
}

// The numbers must not change, because firmware logs them.
static_assert(CO_DICT_NOT_ASCENDING == 1 && CO_DICT_NO_DATA == 3 && CO_DICT_WRONG_PLACE == 6);
static_assert(CO_DICT_DIRECT_CONST == 9 && CO_DICT_PARA_OVERLAP == last_fault);
static_assert(CO_ERR_OBJ_RANGE_LOW == 0x15C && CO_ERR_NODE_SDO_BUF == last_error);

}  // namespace
