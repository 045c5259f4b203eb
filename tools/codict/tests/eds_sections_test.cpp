// SPDX-License-Identifier: Apache-2.0
// Reading of an EDS: sections, lines, characters; in the form of CiA 306 and in others that exist.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "eds/read.hpp"
#include "eds/rules.hpp"
#include "eds/write.hpp"
#include "reading.hpp"

using namespace lexican::codict;
using test::meaning;
using test::Reading;

TEST_CASE("EDS: the section name of an object is case-insensitive, with or without leading zeros") {
  const Reading eds("section_form.eds");
  CHECK(eds.at(0x200A, 1).name.text == "First");
  CHECK(meaning(eds.value(0x200A, 0)) == "1");
  CHECK(eds.device.find(0x0002)->object_code.value == ObjectCode::deftype);
  CHECK(eds.found() ==
        "24:2 eds-section-form\n29:2 eds-section-form\n36:2 eds-section-zeros\n42:2 eds-section-zeros\n");
}

TEST_CASE("EDS: an index with 0x or h, or of letters only, is read") {
  const Reading eds("section_mark.eds");
  CHECK(eds.at(0x2040).name.text == "Prefix");
  CHECK(eds.at(0x2041, 1).name.text == "First");
  CHECK(eds.device.find(0x0FFF)->object_code.value == ObjectCode::deftype);
  CHECK(eds.device.find(0x00A0)->data_type.value == 3);
  CHECK(eds.at(0x00B2, 1).name.text == "Type");
  CHECK(eds.found() ==
        "25:2 eds-section-mark\n31:2 eds-section-mark\n36:2 eds-section-mark\n43:2 eds-section-mark\n"
        "49:2 eds-section-zeros\n55:2 eds-section-unknown\n58:2 eds-section-zeros\n58:2 eds-section-mark\n"
        "64:2 eds-section-unknown\n67:2 eds-section-unknown\n70:2 eds-section-zeros\n70:2 eds-section-mark\n70:2 "
        "od-sub-zero-missing\n"
        "75:2 eds-section-zeros\n75:2 eds-section-mark\n");
  CHECK(eds.findings.all().at(3).hint == "write [2041sub1]");
}

TEST_CASE("EDS: a section whose name is a word of the letters A to F is an object if it has keys of objects") {
  const Reading eds("section_mark.eds");
  for (const int index : {0x0BAC, 0xFACE, 0x00A1}) {
    CHECK(eds.device.find(static_cast<std::uint16_t>(index)) == nullptr);
  }
  const std::string written = eds::write(eds.device, {});
  for (const char* const name : {"[Bach]", "[FACE]", "[A1h]"}) {
    CAPTURE(name);
    CHECK(written.find(std::string(name) + "\r\nText=Of another tool\r\n") != std::string::npos);
  }
  Findings findings;
  const eds::Document document(
      Source("word.eds", "[FACE]\nParameterName=x\nDataType=5\n[BAD]\nReason=x\n[DEAD]\nDefaultValue=1\n"), findings);
  const Description description = eds::read(document, findings);
  CHECK(description.devices.front().find(0xFACE)->data_type.value == type_code::unsigned8);
  CHECK(description.devices.front().objects.size() == 2);
}

TEST_CASE("EDS: text after a section name is ignored") {
  const Reading eds("section_tail.eds");
  CHECK(eds.at(0x2000).name.text == "Speed");
  CHECK(eds.found() == "24:8 eds-syntax-section-tail\n");
}

TEST_CASE("EDS: a section without its closing bracket is read; one without a name is kept") {
  const Reading eds("section_open.eds");
  CHECK(eds.at(0x2000).name.text == "Speed");
  CHECK(eds.device.others.at(0).children.at(0).name == "Word");
  CHECK(eds.found() == "24:1 eds-syntax-section\n30:1 eds-syntax-section\n30:2 eds-section-unknown\n");
}

TEST_CASE("EDS: an unknown section is kept") {
  const Reading eds("section_unknown.eds");
  CHECK(eds.device.others.at(0).name == "Tools");
  CHECK(eds.device.others.at(0).children.size() == 2);
  CHECK(eds.device.others.at(1).name == "Weather");
  CHECK(eds.device.others.at(1).children.at(0).text.text == "blue");
  CHECK(eds.found() == "24:2 eds-section-unknown\n");
}

TEST_CASE("EDS: a section with a sub-index beyond FFh is an error that suggests the decimal reading") {
  const auto found = [](const std::string& name) {
    Findings findings;
    const eds::Document document(Source("large.eds", "[D000]\nObjectType=8\n[" + name + "]\nParameterName=x\n"),
                                 findings);
    const Description description = eds::read(document, findings);
    CHECK(description.devices.front().find(0xD000)->subs.empty());
    CHECK(description.devices.front().others.back().name == name);
    std::string text;
    for (const Finding& finding : findings.all()) {
      text += finding.rule == &eds::rules::sub_index ? finding.text + "; " + finding.hint + "\n" : "";
    }
    return text;
  };
  CHECK(found("D000sub100") ==
        "sub-index of D000h beyond FFh; the section is not used; sub-indexes are hexadecimal: write [D000sub64] for "
        "decimal 100, and the others of D000h likewise\n");
  const std::string no_decimal =
      "sub-index of D000h beyond FFh; the section is not used; sub-indexes are 0 to FEh, and FFh for the structure of "
      "the object\n";
  CHECK(found("d000SUB1A0") == no_decimal);
  CHECK(found("D000sub256") == no_decimal);
  CHECK(found("D000sub99999999999") == no_decimal);
  CHECK(found("D000sub99999999999999999999") == "");  // the number exceeds 64 bits: an unknown section
  CHECK(found("D000subject") == "");
  CHECK(found("M1FixedD000sub255x") == "");
}

TEST_CASE("EDS: sub-indices above FFh are reported in the sections of modules") {
  Findings findings;
  const eds::Document document(Source("module.eds", "[M1Fixed6000sub100]\nParameterName=x\n"), findings);
  eds::read(document, findings);
  CHECK(findings.count(eds::rules::sub_index) == 1);
}

TEST_CASE("EDS: of duplicate keys the first one is used and the second one kept") {
  const Reading eds("duplicate_key.eds");
  CHECK(eds.at(0x2000).name.text == "First");
  CHECK(eds.at(0x2000).others.at(0).text.text == "Second");
  CHECK(eds.found() == "26:1 eds-duplicate-key\n");
}

TEST_CASE("EDS: of duplicate sections of an object the first one is used and the second one kept") {
  const Reading eds("duplicate_section.eds");
  CHECK(eds.at(0x2000).name.text == "First");
  CHECK(eds.at(0x2001, 0).name.text == "First");
  CHECK(eds.device.others.at(0).children.at(0).text.text == "Second");
  CHECK(eds.device.others.at(1).children.at(0).text.text == "Second");
  CHECK(eds.found() == "31:2 eds-duplicate-section\n49:2 eds-section-zeros\n49:2 eds-duplicate-section\n");
}

TEST_CASE("EDS: a sub-object without its object is read; a list without its object is kept") {
  const Reading eds("orphan.eds");
  CHECK(meaning(eds.value(0x2000, 1)) == "4");
  CHECK(eds.device.find(0x2000)->object_code.value == ObjectCode::record);
  CHECK(eds.device.others.at(0).name == "2001Value");
  CHECK(eds.found() ==
        "20:2 eds-section-orphan\n20:2 eds-list-unlisted\n20:2 od-sub-zero-missing\n27:2 eds-section-orphan\n");
}

TEST_CASE("EDS: a file may consist of one object") {
  const Reading eds("no_headers.eds");
  CHECK(meaning(eds.value(0x2000)) == "3");
  CHECK(eds.found() ==
        "1:1 eds-section-missing\n1:1 eds-section-missing\n1:1 eds-section-missing\n1:2 eds-list-unlisted\n");
}

TEST_CASE("EDS: lines with other comment characters are comments") {
  const Reading eds("comments.eds");
  CHECK(eds.at(0x2000).name.text == "One");
  CHECK(eds.found() == "24:1 eds-syntax-comment\n25:2 eds-syntax-comment\n26:1 eds-syntax-indent\n");
}

TEST_CASE("EDS: a line without a key is ignored") {
  CHECK(Reading("line_without_key.eds").found() == "20:1 eds-syntax-line\n21:1 eds-syntax-line\n");
}

TEST_CASE("EDS: a key before all sections is kept") {
  const Reading eds("key_outside.eds");
  CHECK(eds.device.others.at(0).children.at(0).name == "Lost");
  CHECK(eds.found() == "1:1 eds-syntax-outside\n");
}

TEST_CASE("EDS: a line of more than 255 characters is read") {
  const Reading eds("long_line.eds");
  CHECK(eds.value(0x2000).text.size() == 300);
  CHECK(eds.found() == "29:256 eds-syntax-length\n");
}

TEST_CASE("EDS: lines end with LF or CR LF, the last one with either or none; or all with CR") {
  const Reading mixed("line_ends.eds");
  CHECK(mixed.device.manufacturer.count.value == 1);
  CHECK(mixed.at(0x2000).access.value == Access::rw);
  CHECK(mixed.found() == "20:22 eds-syntax-line-end\n");
  const Reading dos("dos_lines.eds");
  CHECK(dos.at(0x2000).access.text == "rw");
  CHECK(dos.found().empty());
  Findings findings;
  std::string bytes(dos.document.source().bytes());
  bytes.erase(std::remove(bytes.begin(), bytes.end(), '\n'), bytes.end());
  const eds::Document mac(Source("mac.eds", bytes), findings);
  CHECK(mac.sections().size() == dos.document.sections().size());
  CHECK(mac.line_end() == "\r");
  Edits edits;
  CHECK(mac.add_key(mac.sections().front(), "CreatedBy", "x", edits));
  CHECK(edits.applied_to(bytes).find("\rCreatedBy=x\r") != std::string::npos);
  CHECK(findings.all().empty());
}

TEST_CASE("EDS: a no-break space in the name of a key is reported") {
  Findings findings;
  const eds::Document document(Source("a.eds", u8"[FileInfo]\nFileName\u00A0=a.eds\n"), findings);
  REQUIRE(findings.count(eds::rules::syntax_key) == 1);
  CHECK(findings.all().back().text == "no-break space in key 'FileName<U+00A0>', which is unknown");
}

TEST_CASE("EDS: characters beyond ASCII are read as UTF-8, else with a guessed encoding") {
  const Reading utf8("utf8.eds");
  CHECK(utf8.at(0x2000).name.text == u8"Größe");
  CHECK(utf8.found() == "25:17 eds-encoding-utf8\n");
  const Reading marked("utf8_mark.eds");
  CHECK(marked.at(0x2000).name.text == u8"Größe");
  CHECK(marked.device.file.file_name.text == "utf8_mark.eds");
  CHECK(marked.found() == "1:1 eds-encoding-mark\n25:17 eds-encoding-utf8\n");
  const Reading dos("cp850.eds");
  CHECK(dos.at(0x2000).name.text == u8"Größe für Öl");
  CHECK(dos.found() == "25:17 eds-encoding-guess\n");
  const Reading windows("cp1252.eds");
  CHECK(windows.at(0x2000).name.text == u8"Größe für 20 °C");
  CHECK(windows.found() == "25:17 eds-encoding-guess\n");
}

TEST_CASE("EDS: a control character is kept") {
  const Reading eds("control_character.eds");
  CHECK(eds.at(0x2000).name.text == "Be\x07ll");
  CHECK(eds.found() == "25:17 eds-syntax-control\n");
}
