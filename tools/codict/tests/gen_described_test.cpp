// SPDX-License-Identifier: Apache-2.0
// Description of a generated device whose source description is incomplete or differs from it.
#include <doctest/doctest.h>

#include <string>

#include "eds/document.hpp"
#include "eds/read.hpp"
#include "eds/write.hpp"
#include "gen/gen.hpp"
#include "program.hpp"
#include "xdd_reading.hpp"

using namespace lexican::codict;
using test::has;

namespace {

std::string parameter(const std::string& id, const std::string& access, const std::string& rest) {
  return "<parameter uniqueID=\"P" + id + "\" access=\"" + access + "\">" + rest + "</parameter>";
}

std::string object(const std::string& index, int type, const std::string& rest) {
  return "<CANopenObject index=\"" + index + "\" name=\"Object\" objectType=\"" + std::to_string(type) + "\" " + rest;
}

std::string variable(const std::string& index) { return object(index, 7, "uniqueIDRef=\"P" + index + "\"/>"); }

// Returns the EDS that matches the dictionary of a device.
std::string matching_eds(const Device& device) {
  gen::Options options;
  options.name = "small";
  Findings findings;
  const gen::Output output = gen::generate(device, options, findings);
  REQUIRE(!output.files.empty());
  return eds::write(output.device, {false, "\n"});
}

std::string matching_eds(const std::string& objects, const std::string& parameters) {
  return matching_eds(test::XmlReading(test::xdd_with(objects, parameters)).device);
}

}  // namespace

TEST_CASE("gen: a disabled object is in no generated description") {
  const std::string eds = matching_eds(
      variable("2000") + variable("2001"),
      parameter("2000", "read", "<USINT/><defaultValue value=\"1\"/><property name=\"CO_disabled\" value=\"true\"/>") +
          parameter("2001", "read", "<USINT/><defaultValue value=\"1\"/>"));
  CHECK_FALSE(has(eds, "[2000]"));
  CHECK(has(eds, "SupportedObjects=1\n1=0x2001\n"));
}

TEST_CASE("gen: a missing sub-index 0 is added to the description") {
  const std::string eds = matching_eds(
      object("2000", 9, "><CANopenSubObject subIndex=\"03\" name=\"Value\" objectType=\"7\" uniqueIDRef=\"P1\"/>") +
          "</CANopenObject>",
      parameter("1", "readWrite", "<USINT/><defaultValue value=\"7\"/>"));
  CHECK(has(eds, "SubNumber=2\n\n[2000sub0]\n"));
  CHECK(has(eds,
            "[2000sub0]\nParameterName=Object Highest sub-index supported\nObjectType=0x7\nDataType=0x0005\n"
            "AccessType=const\nDefaultValue=3\n"));
}

TEST_CASE("gen: corrected COB-IDs and types are written to the description") {
  const std::string eds = matching_eds(
      object("1200", 9, "><CANopenSubObject subIndex=\"01\" name=\"COB-ID\" objectType=\"7\" uniqueIDRef=\"P1\"/>") +
          "</CANopenObject>" + variable("1017"),
      parameter("1", "read", "<UDINT/><defaultValue value=\"0x600\"/>") +
          parameter("1017", "readWrite", "<UDINT/><defaultValue value=\"1000\"/>"));
  CHECK(has(eds,
            "[1200sub1]\nParameterName=COB-ID\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\n"
            "DefaultValue=$NODEID+0x600\n"));
  CHECK(has(eds,
            "[1017]\nParameterName=Object\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\n"
            "DefaultValue=1000\n"));
}

TEST_CASE("gen: the error history is described without entries for its errors") {
  const std::string eds = matching_eds(
      object("1003", 8, "><CANopenSubObject subIndex=\"00\" name=\"Number\" objectType=\"7\" uniqueIDRef=\"P0\"/>") +
          "<CANopenSubObject subIndex=\"01\" name=\"Error\" objectType=\"7\" uniqueIDRef=\"P1\"/></CANopenObject>",
      parameter("0", "readWrite", "<USINT/>") + parameter("1", "read", "<UDINT/><defaultValue value=\"0\"/>"));
  CHECK(has(eds, "ParameterName=Number\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\n"));
  CHECK(has(eds, "ParameterName=Error\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\n"));
  CHECK_FALSE(has(eds, "AccessType=ro\nDefaultValue"));
}

TEST_CASE("gen: configured values are the default values of the generated device") {
  const std::string eds =
      matching_eds(variable("2000"),
                   parameter("2000", "readWrite", "<USINT/><actualValue value=\"9\"/><defaultValue value=\"1\"/>"));
  CHECK(has(eds, "DefaultValue=9\n"));
  CHECK_FALSE(has(eds, "ParameterValue"));
}

TEST_CASE("gen: values of compact storage are the defaults of sub-objects described separately") {
  const std::string bytes =
      "[2000]\nParameterName=Gain\nObjectType=8\nDataType=6\nAccessType=rw\nDefaultValue=100\nCompactSubObj=3\n"
      "[2000Value]\nNrOfEntries=1\n2=0x10\n";
  Findings findings;
  const eds::Document document(Source("compact.eds", bytes), findings);
  const std::string eds = matching_eds(eds::read(document, findings).devices.front());
  CHECK_FALSE(has(eds, "CompactSubObj"));
  CHECK(
      has(eds, "[2000sub1]\nParameterName=Gain1\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"));
  CHECK(
      has(eds, "[2000sub2]\nParameterName=Gain2\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0x10\n"));
}

TEST_CASE("gen: the numbers of PDOs are those of the dictionary") {
  const std::string pdo =
      "><CANopenSubObject subIndex=\"01\" name=\"COB-ID\" objectType=\"7\" uniqueIDRef=\"P1\"/>"
      "</CANopenObject>";
  const std::string eds = matching_eds(object("1400", 9, pdo) + object("1801", 9, pdo) + object("1802", 9, pdo),
                                       parameter("1", "readWrite", "<UDINT/>"));
  CHECK(has(eds, "NrOfRXPDO=1\nNrOfTXPDO=2\n"));
}
