// SPDX-License-Identifier: Apache-2.0
// Parts of a dictionary that the application defines: object types and memory.
#include <doctest/doctest.h>

#include <string>

#include "gen/gen.hpp"
#include "program.hpp"
#include "xdd_reading.hpp"

using namespace lexican::codict;
using test::has;

namespace {

// Returns header and source for an XML description with two parameters, each with an object from 2000h on.
std::string generated(const std::string& first, const std::string& second) {
  const auto parameter = [](const std::string& id, const std::string& text) {
    return "<parameter uniqueID=\"P" + id + "\"" + text + "</parameter>";
  };
  const auto object = [](const std::string& id) {
    return "<CANopenObject index=\"" + id + "\" name=\"Value " + id + "\" objectType=\"7\" uniqueIDRef=\"P" + id +
           "\"/>";
  };
  const test::XmlReading reading(
      test::xdd_with(object("2000") + object("2001"), parameter("2000", first) + parameter("2001", second)));
  gen::Options options;
  options.name = "small";
  Findings findings;
  const gen::Output output = gen::generate(reading.device, options, findings);
  REQUIRE(output.files.size() == 2);
  return output.files[0].bytes + output.files[1].bytes;
}

const std::string own = "<property name=\"CO_extensionIO\" value=\"true\"/>";

}  // namespace

TEST_CASE("gen: an application-defined type has a variable if it has a value; its limits are not checked") {
  const std::string text = generated(
      " access=\"readWrite\"><USINT/><defaultValue value=\"7\"/><allowedValues><range><minValue value=\"0\"/>"
      "<maxValue value=\"9\"/></range></allowedValues>" +
          own,
      " access=\"const\"><UINT/><defaultValue value=\"3\"/>" + own);
  CHECK(has(text, "extern const CO_OBJ_TYPE small_2000_0_type;\n"));
  CHECK(has(text, "{SMALL_2000_0 | CO_OBJ_____RW, &small_2000_0_type, (CO_DATA)(&small_ram.od_2000_0)},"));
  CHECK(has(text, "{7u},  // od_2000_0\n"));
  CHECK(has(text, "{SMALL_2001_0 | CO_OBJ_____R_, &small_2001_0_type, (CO_DATA)(&small_ram.od_2001_0)},"));
  CHECK_FALSE(has(text, "limits_1"));
}

TEST_CASE("gen: an application-defined type without a value or of any length has no variable") {
  const std::string text = generated(" access=\"readWrite\"><USINT/>" + own,
                                     " access=\"readWrite\"><STRING/><defaultValue value=\"text\"/>" + own);
  CHECK(has(text, "{SMALL_2000_0 | CO_OBJ_____RW, &small_2000_0_type, (CO_DATA)(0)},"));
  CHECK(has(text, "{SMALL_2001_0 | CO_OBJ_____RW, &small_2001_0_type, (CO_DATA)(0)},"));
}

TEST_CASE("gen: a text of the application is a CO_OBJ_STR if it is read-only, else a CO_OBJ_STR_RW") {
  const std::string label = "<property name=\"CO_countLabel\" value=\"TEXTS\"/>";
  const std::string text = generated(" access=\"const\"><STRING/>" + label, " access=\"readWrite\"><STRING/>" + label);
  CHECK(has(text, "extern CO_OBJ_STR small_2000_0;\n"));
  CHECK(has(text, "{SMALL_2000_0 | CO_OBJ_____R_, CO_TSTRING, (CO_DATA)(&small_2000_0)},"));
  CHECK(has(text, "extern CO_OBJ_STR_RW small_2001_0;\n"));
  CHECK(has(text, "{SMALL_2001_0 | CO_OBJ_____RW, CO_TVISIBLE_STRING, (CO_DATA)(&small_2001_0)},"));
}
