// SPDX-License-Identifier: Apache-2.0
#include "large_xdd.hpp"

#include <fmt/format.h>

namespace test {

namespace {

constexpr unsigned subs_of_record = 250;

constexpr const char* mandatory_objects = R"(
  <CANopenObject index="1000" name="Device type" objectType="7" dataType="0007" accessType="ro" defaultValue="0"/>
  <CANopenObject index="1001" name="Error register" objectType="7" dataType="0005" accessType="ro" defaultValue="0"/>
  <CANopenObject index="1017" name="Producer heartbeat time" objectType="7" dataType="0006" accessType="rw" defaultValue="0"/>
  <CANopenObject index="1018" name="Identity object" objectType="9" subNumber="2">
    <CANopenSubObject subIndex="00" name="Highest sub-index" objectType="7" dataType="0005" accessType="const" defaultValue="1"/>
    <CANopenSubObject subIndex="01" name="Vendor-ID" objectType="7" dataType="0007" accessType="ro" defaultValue="1"/>
  </CANopenObject>
)";

std::string id_of(unsigned n) { return fmt::format("UID_PARAM_{:05X}", n); }

std::string parameter(unsigned n) {
  return fmt::format(
      "  <parameter uniqueID=\"{}\" access=\"readWrite\">\n"
      "    <label lang=\"en\">Parameter number {}</label>\n"
      "    <description lang=\"en\">What it is for, in some words, as descriptions have them.</description>\n"
      "    <UINT/>\n    <defaultValue value=\"0x{:04X}\"/>\n"
      "    <allowedValues><range><minValue value=\"0\"/><maxValue value=\"0xFFFF\"/></range></allowedValues>\n"
      "    <property name=\"CO_storageGroup\" value=\"RAM\"/>\n  </parameter>\n",
      id_of(n), n, n & 0xFFFFU);
}

std::string object(unsigned n) {
  return fmt::format(
      "  <CANopenObject index=\"{:04X}\" name=\"Parameter number {}\" objectType=\"7\" PDOmapping=\"optional\" "
      "uniqueIDRef=\"{}\"/>\n",
      0x2000 + n, n, id_of(n));
}

std::string begin_of_record(unsigned record) {
  return fmt::format(
      "  <CANopenObject index=\"{:04X}\" name=\"Record {}\" objectType=\"9\" subNumber=\"{}\">\n"
      "    <CANopenSubObject subIndex=\"00\" name=\"Highest sub-index supported\" objectType=\"7\" dataType=\"0005\" "
      "accessType=\"const\" defaultValue=\"{}\" PDOmapping=\"no\"/>\n",
      0x2000 + record, record, subs_of_record + 1, subs_of_record);
}

std::string sub_object(unsigned n, bool has_parameter) {
  const std::string begin =
      fmt::format("    <CANopenSubObject subIndex=\"{:02X}\" name=\"Member {} of record {}\" objectType=\"7\" ",
                  n % subs_of_record + 1, n % subs_of_record + 1, n / subs_of_record);
  return begin + (has_parameter ? fmt::format("PDOmapping=\"optional\" uniqueIDRef=\"{}\"/>\n", id_of(n))
                                : fmt::format("dataType=\"0006\" accessType=\"rw\" defaultValue=\"0x{:04X}\" "
                                              "PDOmapping=\"optional\"/>\n",
                                              n & 0xFFFFU));
}

}  // namespace

std::string large_xdd(Large kind, std::size_t bytes) {
  std::string parameters;
  std::string objects;
  for (unsigned n = 0; parameters.size() + objects.size() < bytes; ++n) {
    parameters += kind == Large::sub_objects ? "" : parameter(n);
    if (kind == Large::objects) {
      objects += object(n);
      continue;
    }
    if (n % subs_of_record == 0) {
      objects += (n == 0 ? "" : "  </CANopenObject>\n") + begin_of_record(n / subs_of_record);
    }
    objects += sub_object(n, kind == Large::described_sub_objects);
  }
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<ISO15745ProfileContainer "
         "xmlns=\"http://www.canopen.org/xml/1.1\">\n"
         "<ISO15745Profile><ProfileHeader/><ProfileBody><ApplicationProcess><parameterList>\n" +
         parameters +
         "</parameterList></ApplicationProcess></ProfileBody></ISO15745Profile>\n"
         "<ISO15745Profile><ProfileHeader/><ProfileBody><ApplicationLayers><CANopenObjectList>" +
         (mandatory_objects + objects) + (kind == Large::objects ? "" : "  </CANopenObject>\n") +
         "</CANopenObjectList></ApplicationLayers></ProfileBody></ISO15745Profile></ISO15745ProfileContainer>\n";
}

}  // namespace test
