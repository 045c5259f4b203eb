// SPDX-License-Identifier: Apache-2.0
// PDOs that an EDS counts but does not describe (CompactPDO).
#include <doctest/doctest.h>

#include <string>

#include "check/check.hpp"
#include "convert/write.hpp"
#include "diff/diff.hpp"
#include "eds/read.hpp"
#include "eds/rules.hpp"
#include "gen/gen.hpp"
#include "model/pdo.hpp"
#include "program.hpp"
#include "reading.hpp"

using namespace lexican::codict;

namespace {

struct Device306 {
  explicit Device306(const std::string& device_info, const std::string& sections = {})
      : document(Source("implied.eds", "[DeviceInfo]\n" + device_info + sections), findings),
        device(eds::read(document, findings).devices.front()) {}

  std::string default_of(std::uint16_t index, std::uint8_t sub_index) const {
    const Entry* const entry = device.find(index, sub_index);
    return entry != nullptr ? test::meaning(entry->default_value) : "missing";
  }
  std::string notes() const {
    std::string text;
    for (const Finding& finding : findings.all()) {
      text += finding.rule == &eds::rules::compact_pdo ? finding.text + "\n" : "";
    }
    return text;
  }

  Findings findings;
  eds::Document document;
  Device device;
};

const std::string described =
    "[1800]\nParameterName=x\nObjectType=9\n[1800sub1]\nParameterName=x\nDataType=7\nAccessType=rw\nDefaultValue=5\n"
    "[1A00]\nParameterName=x\nObjectType=9\n[1A00sub0]\nParameterName=x\nDataType=5\nAccessType=rw\n";

}  // namespace

TEST_CASE("EDS: PDOs implied by CompactPDO are added with the sub-indices of its bits") {
  const Device306 eds("NrOfRXPDO=5\nNrOfTXPDO=2\nCompactPDO=0x17\n", described);
  CHECK(pdos_of(eds.device).size() == 7);
  CHECK(eds.default_of(0x1400, 0) == "5");
  CHECK(eds.default_of(0x1400, 1) == "$NODEID+2147484160");  // 0x80000200
  CHECK(eds.default_of(0x1403, 1) == "$NODEID+2147484928");  // 0x80000500
  CHECK(eds.default_of(0x1404, 1) == "2147483648");          // disabled: not in the predefined connection set
  CHECK(eds.default_of(0x1400, 2) == "255");
  CHECK(eds.default_of(0x1400, 3) == "0");
  CHECK(eds.default_of(0x1400, 4) == "missing");
  CHECK(eds.default_of(0x1400, 5) == "0");
  CHECK(eds.default_of(0x1400, 6) == "missing");
  CHECK(eds.default_of(0x1600, 0) == "0");
  CHECK(eds.default_of(0x1600, 8) == "0");
  CHECK(eds.default_of(0x1600, 9) == "missing");
  CHECK(eds.default_of(0x1800, 1) == "5");  // the section has priority
  CHECK(eds.default_of(0x1800, 2) == "missing");
  CHECK(eds.default_of(0x1801, 1) == "$NODEID+2147484288");  // 0x80000280
  CHECK(eds.notes() ==
        "10 parameter objects of RPDOs have no section; CompactPDO implies them, disabled\n"
        "2 parameter objects of TPDOs have no section; CompactPDO implies them, disabled\n");
}

TEST_CASE("EDS: implied PDOs get the lowest free indices; incomplete ones are completed") {
  const Device306 eds("NrOfTXPDO=3\nCompactPDO=1\nGranularity=1\n",
                      "[1801]\nParameterName=x\nObjectType=9\n[1801sub1]\nParameterName=x\nDataType=7\n");
  CHECK(eds.default_of(0x1800, 2) == "255");  // value that CiA 301 requires
  CHECK(eds.default_of(0x1A01, 64) == "0");
  CHECK(eds.default_of(0x1802, 0) == "2");
  CHECK(eds.device.find(0x1803) == nullptr);
  CHECK(eds.device.find(0x1400) == nullptr);
}

TEST_CASE("EDS: without CompactPDO, or if all PDOs are described, none is added") {
  CHECK(Device306("NrOfTXPDO=2\n", described).device.objects.size() == 2);
  CHECK(Device306("NrOfTXPDO=2\nCompactPDO=0\n", described).device.objects.size() == 2);
  CHECK(Device306("NrOfTXPDO=1\nCompactPDO=3\n", described).notes().empty());
  CHECK(Device306("NrOfTXPDO=0\nCompactPDO=3\n", described).notes().empty());
}

TEST_CASE("EDS: CompactPDO allocates a limited amount of memory") {
  const Device306 eds("NrOfRXPDO=65535\nNrOfTXPDO=65535\nCompactPDO=0xFFFFFFFF\nGranularity=1\n");
  CHECK(eds.findings.count(eds::rules::compact_limit) == 1);
  CHECK(eds.device.objects.size() == 1024);  // 512 PDOs of one direction, two objects each
  CHECK(eds.default_of(0x1400, 6) == "0");
  CHECK(eds.default_of(0x1400, 7) == "missing");
}

TEST_CASE("EDS: implied PDOs have no findings and become sections of a DCF and entries of a dictionary") {
  Device306 eds("NrOfRXPDO=1\nNrOfTXPDO=0\nCompactPDO=0x3F\n");
  Findings findings;
  check::check_all(eds.device, findings);
  for (const Finding& finding : findings.all()) {
    const bool is_of_pdo = finding.rule->id.substr(0, 3) == "pdo" || finding.rule->id.substr(0, 3) == "cob" ||
                           finding.rule->id.substr(0, 6) == "od-sub";
    CHECK_MESSAGE(!is_of_pdo, finding.text);
  }
  const std::string dcf = convert::write(eds.device, convert::Target::dcf, xdd::Edition::v11, "");
  const std::size_t cob_id = dcf.find("[1400sub1]");
  REQUIRE(cob_id != std::string::npos);
  CHECK(test::has(dcf.substr(cob_id, 150), "DefaultValue=$NODEID+0x80000200"));
  Findings again;
  const eds::Document document(Source("a.dcf", dcf), again);
  CHECK(diff::compare(eds.device, eds::read(document, again).devices.front()).empty());
  gen::Options options;
  options.name = "device";
  CHECK_FALSE(gen::generate(eds.device, options, again).files.empty());
}
