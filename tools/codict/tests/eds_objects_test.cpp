// SPDX-License-Identifier: Apache-2.0
// Reading of an EDS: keys of objects, lists of objects, sub-objects; in the form of CiA 306 and in others that exist.
#include <doctest/doctest.h>

#include "reading.hpp"

using namespace lexican::codict;
using test::meaning;
using test::Reading;

TEST_CASE("EDS: access types are case-insensitive; other words are unknown") {
  const Reading eds("access.eds");
  CHECK(eds.at(0x2000).access.value == Access::rww);
  CHECK(eds.at(0x2001).access.value == Access::constant);
  CHECK(eds.at(0x2002).access.value == Access::unknown);
  CHECK(eds.at(0x2002).access.text == "UNKNOWN");
  CHECK(eds.found() ==
        "32:12 eds-access-case\n38:12 eds-access-case\n45:12 eds-access-unknown\n51:12 eds-access-unknown\n"
        "57:12 eds-access-unknown\n");
  CHECK(eds.findings.all().at(2).hint == "write ro, wo, rw, rwr, rww or const");
  CHECK(eds.findings.all().at(3).hint == "write ro");
  CHECK(eds.findings.all().at(4).hint == "write wo");
}

TEST_CASE("EDS: without ObjectType an object is a VAR, or a RECORD if it has sub-objects") {
  const Reading eds("object_type_missing.eds");
  CHECK(eds.device.find(0x2000)->object_code.value == ObjectCode::variable);
  CHECK(eds.device.find(0x2001)->object_code.value == ObjectCode::record);
  CHECK(eds.found() == "25:2 eds-object-type-missing\n30:2 eds-object-type-missing\n");
}

TEST_CASE("EDS: an unknown ObjectType is a VAR, and the sub-objects of a VAR are kept") {
  const Reading eds("object_type.eds");
  CHECK(eds.device.find(0x2000)->object_code.value == ObjectCode::variable);
  CHECK(eds.device.find(0x2001)->subs.size() == 1);
  CHECK(eds.found() == "28:12 eds-object-type\n34:12 eds-object-type\n47:12 eds-object-type\n");
  CHECK(eds.findings.all().at(2).text == "object type VAR, but there are sub-objects (CompactSubObj)");
}

TEST_CASE("EDS: an empty value counts as a missing key [306: 4.2]") {
  const Reading eds("key_missing.eds");
  CHECK(eds.device.find(0x2000)->data_type.is_given);
  CHECK(eds.found() == "24:2 eds-key-missing\n24:2 eds-key-missing\n24:2 eds-key-missing\n");
}

TEST_CASE("EDS: a key in a wrong section is kept") {
  const Reading eds("key_misplaced.eds");
  CHECK(eds.device.find(0x2000)->data_type.text == "0x0005");
  CHECK(eds.at(0x2000, 0).others.at(0).text.text == "1");
  CHECK(eds.found() == "27:10 eds-key-misplaced\n28:12 eds-key-misplaced\n37:1 eds-key-misplaced\n");
}

TEST_CASE("EDS: an unknown key is kept") {
  const Reading eds("key_unknown.eds");
  CHECK(eds.at(0x2000).others.at(0).name == "Colour");
  CHECK(eds.at(0x2000).others.at(0).text.text == "red");
  CHECK(eds.found() == "29:1 eds-key-unknown\n");
}

TEST_CASE("EDS: blanks around a key and its value, and within a key, are ignored") {
  const Reading eds("key_blanks.eds");
  CHECK(eds.device.optional.count.value == 1);
  CHECK(eds.at(0x1001).name.text == "Error register");
  CHECK(eds.at(0x1001).data_type.value == type_code::unsigned8);
  CHECK(eds.found() == "21:1 eds-syntax-key\n22:4 eds-list-wrong\n");
}

TEST_CASE("EDS: Factor, Unit and Description of python-canopen are read") {
  const Reading eds("python_canopen.eds");
  CHECK(eds.device.dialect == "python-canopen");
  CHECK(eds.at(0x2000).multiplier->text == "0.1");
  CHECK(eds.at(0x2000).unit->texts.labels.at(0).text.text == "mV");
  CHECK(eds.at(0x2000).texts->descriptions.at(0).text.text == "Between the phases");
  CHECK(eds.found() == "29:1 eds-dialect\n30:1 eds-dialect\n31:1 eds-dialect\n");
}

TEST_CASE("EDS: storage group and TPDO trigger in comments are read") {
  const Reading eds("storage_location.eds");
  CHECK(eds.at(0x2000).node->storage_group.value == "PERSIST_COMM");
  CHECK(eds.at(0x2000).node->flags_pdo->value);
  CHECK(eds.found() == "27:2 eds-hidden-key\n30:2 eds-hidden-key\n");
}

TEST_CASE("EDS: an object missing in all lists is read") {
  const Reading eds("unlisted.eds");
  CHECK(meaning(eds.value(0x2000)) == "3");
  CHECK_FALSE(eds.device.find(0x2000)->is_listed);
  CHECK(eds.found() == "20:2 eds-list-unlisted\n");
}

TEST_CASE("EDS: without lists, all objects are read") {
  const Reading eds("no_lists.eds");
  CHECK(meaning(eds.value(0x2000)) == "3");
  CHECK(eds.found() == "1:1 eds-section-missing\n1:1 eds-section-missing\n4:2 eds-list-unlisted\n");
}

TEST_CASE("EDS: a listed object without a section is reported") {
  const Reading eds("listed_without_section.eds");
  CHECK(eds.device.manufacturer.indexes.size() == 2);
  CHECK(eds.device.find(0x2001) == nullptr);
  CHECK(eds.found() == "23:3 eds-list-no-section\n");
}

TEST_CASE("EDS: all entries of a list are read, whatever its number") {
  const Reading eds("list_count.eds");
  CHECK(eds.device.find(0x2001)->is_listed);
  CHECK(eds.found() == "21:18 eds-list-count\n");
}

TEST_CASE("EDS: the entries of a list are decimal numbers without gaps") {
  const Reading eds("list_gap.eds");
  CHECK(eds.device.find(0x2001)->is_listed);
  CHECK(eds.found() == "23:1 eds-list-numbers\n");
}

TEST_CASE("EDS: an object is in one list, once") {
  CHECK(Reading("list_twice.eds").found() == "23:3 eds-list-twice\n");
  CHECK(Reading("list_wrong.eds").found() == "22:3 eds-list-wrong\n");
}

TEST_CASE("EDS: an entry of a list is a number, and not empty") {
  const Reading eds("list_entry.eds");
  CHECK(eds.device.manufacturer.indexes.at(1).text == "speed");
  CHECK(eds.found() == "21:18 eds-list-count\n23:3 od-value-number\n24:1 eds-list-entry\n");
}

TEST_CASE("EDS: SubNumber excludes FFh; a wrong one is reported and the described sub-objects are used [306: 4.6.3]") {
  const Reading eds("sub_number.eds");
  CHECK(eds.device.find(0x2000)->subs.size() == 5);
  CHECK(eds.device.find(0x2000)->sub_number.value == 5);
  CHECK(eds.found() == "28:11 od-sub-number\n");
}

TEST_CASE("sub-index 0 is there, and its default is the highest sub-index") {
  const Reading eds("sub_zero.eds");
  CHECK(meaning(eds.value(0x2000, 0)) == "7");
  CHECK_FALSE(eds.value(0x2000, 0).is_given);
  CHECK(eds.device.find(0x2001, 0) == nullptr);
  CHECK(meaning(eds.value(0x2002, 0)) == "1");
  CHECK(meaning(eds.value(0x2003, 0)) == "0");  // sub-index 0 is writable: its default is the number of entries in use
  CHECK(eds.found() == "32:2 od-sub-zero-value\n52:2 od-sub-zero-missing\n74:14 od-sub-zero-small\n");
}

TEST_CASE("EDS: lists of compact storage add missing values and never replace those of sections") {
  const Reading reading("lists_without_compact.dcf");
  CHECK(reading.at(0x2000, 2).name.text == "Second");
  CHECK(reading.at(0x2000, 2).denotation->text == "gear");
  CHECK(meaning(reading.at(0x2000, 1).actual_value) == "7");
  CHECK(meaning(reading.at(0x2000, 2).actual_value) == "9");
  CHECK(reading.device.find(0x2000)->others.size() == 2);  // [2000Name], and the unused keys of [2000Value]
  CHECK(reading.device.find(0x2001)->others.size() == 1);
  CHECK(reading.found() ==
        "45:1 eds-compact-entry\n49:1 eds-compact-entry\n51:1 eds-compact-entry\n65:1 eds-compact-entry\n"
        "67:2 eds-section-orphan\n");
}
