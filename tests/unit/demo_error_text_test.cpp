// SPDX-License-Identifier: Apache-2.0
// Texts of the demo for the error of its node (name, object, meaning) and for the fault of its dictionary.
#include "co_cfg.h"

#if USE_CSDO  // required by the demo's master
#include <doctest/doctest.h>

#include <string>

#include "host/node.hpp"

namespace {

const CO_IF_CAN_DRV_EX no_can = {[](void*) {},
                                 [](void*, std::uint32_t) {},
                                 [](void*, CO_IF_FRM*) { return std::int16_t{0}; },
                                 [](void*, const CO_IF_FRM*) { return std::int16_t{0}; },
                                 [](void*) {},
                                 [](void*) {},
                                 nullptr,
                                 nullptr};
const CO_IF_TIMER_DRV_EX no_timer = {[](void*, std::uint32_t) {}, [](void*) { return std::uint32_t{0}; }, nullptr};

template <std::uint16_t length>
std::string error_text_of(CO_OBJ (&table)[length]) {
  demo::Node node({1, {&no_can, nullptr}, {&no_timer, nullptr}, {table, length}});
  const std::string words = node.error_text();
  CHECK(node.error_text().empty());
  return words;
}

constexpr CO_OBJ error_register = {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 0};
constexpr CO_OBJ vendor_id = {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, 0};

TEST_CASE("demo errors: no error gives no text") {
  CO_OBJ table[] = {error_register, vendor_id, CO_OBJ_DICT_ENDMARK};
  CHECK(error_text_of(table).empty());
}

#if USE_DICT_CHECK
TEST_CASE("demo errors: name, object and meaning are printed") {
  CO_OBJ table[] = {error_register, CO_OBJ_DICT_ENDMARK};
  CHECK(error_text_of(table) ==
        "CO_ERR_CFG_1018, object 1018h:01: the mandatory object 1018h:1 (vendor-ID) is missing; the node runs");
}

TEST_CASE("demo errors: a refused dictionary is printed with its fault") {
  CO_OBJ table[] = {vendor_id, error_register, CO_OBJ_DICT_ENDMARK};
  CHECK(
      error_text_of(table) ==
      "CO_ERR_DICT_INIT, object 1001h:00: the dictionary is refused; CODictGetFault() returns the fault; "
      "CO_DICT_NOT_ASCENDING, object 1001h:00: the key is not greater than the key before it: sort the table by index "
      "and sub-index");
}
#endif

}  // namespace

#endif
