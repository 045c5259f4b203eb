// SPDX-License-Identifier: Apache-2.0
// The normal form of an EDS or DCF.
#include "eds/format.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "diff/diff.hpp"
#include "eds/read.hpp"
#include "files.hpp"
#include "program.hpp"
#include "reading.hpp"

using namespace lexican::codict;

namespace {

std::string formatted(const std::string& text) {
  Findings findings;
  return eds::formatted(eds::Document(Source("device.eds", text), findings));
}

Device device_of(const std::string& text, const std::string& name) {
  Findings findings;
  const eds::Document document(Source(name, text), findings);
  return eds::read(document, findings).devices.front();
}

// Returns all names of keys and all comments, which the normal form must neither lose nor add.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    const bool is_comment = begin != std::string::npos && line[begin] == ';';
    if (begin != std::string::npos && line[begin] != '[') {
      std::string word = line.substr(begin, is_comment ? std::string::npos : line.find('=') - begin);
      word.erase(word.find_last_not_of(" \t\r") + 1);
      if (!is_comment) {  // case and blanks of names have no meaning
        word.erase(std::remove(word.begin(), word.end(), ' '), word.end());
        std::transform(word.begin(), word.end(), word.begin(),
                       [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; });
      }
      words.push_back(word);
    }
  }
  std::sort(words.begin(), words.end());
  return words;
}

std::size_t check_all_in(const std::string& directory) {
  const std::vector<std::string> paths = test::files_in(directory, test::eds_endings());
  for (const std::string& path : paths) {
    CAPTURE(path);
    const std::string before = test::bytes_of(path);
    const std::string after = formatted(before);
    CHECK(diff::compare(device_of(before, path), device_of(after, path)).empty());
    CHECK(formatted(after) == after);
    CHECK(words_of(after) == words_of(before));
  }
  return paths.size();
}

}  // namespace

TEST_CASE("fmt: an index is written without 0x and h") {
  CHECK(test::has(formatted("[0x2040]\nParameterName=a\n"), "[2040]\n"));
  CHECK(test::has(formatted("[2040hsub1]\nParameterName=a\n"), "[2040sub1]\n"));
}

TEST_CASE("EDS normal form: each fixture describes the same device without loss, and the form is stable") {
  CHECK(check_all_in(test::fixture("")) > 50);
}

TEST_CASE("EDS normal form: each description of the corpus describes the same device without loss" *
          doctest::test_suite(test::needs_corpus) * test::skipped_without_corpus()) {
  CHECK(check_all_in(test::corpus()) > 50);
}

TEST_CASE("EDS normal form: sections have the order of CiA 306; comments stay before their lines") {
  CHECK(formatted(
            "; Top\n[2000sub1]\nParameterName=b\n\n"
            "; The object\n; in two lines\n[2000]\n; its name\nParameterName=a\n;StorageLocation=RAM\n"
            "; Lists\n[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\n\n"
            "[Mine]\nx=1\n[1000]\nParameterName=c\n[1000Name]\nNrOfEntries=0\n[MandatoryObjects]\nSupportedObjects=1\n"
            "1=0x1000\n[FileInfo]\nFileName=x\n; End\n") ==
        "; Top\n\n[FileInfo]\nFileName=x\n\n[MandatoryObjects]\nSupportedObjects=1\n1=0x1000\n\n"
        "[1000]\nParameterName=c\n\n[1000Name]\nNrOfEntries=0\n\n"
        "; Lists\n[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\n"
        "; The object\n; in two lines\n[2000]\n; its name\nParameterName=a\n;StorageLocation=RAM\n\n"
        "[2000sub1]\nParameterName=b\n\n[Mine]\nx=1\n\n; End\n");
}

TEST_CASE("EDS normal form: names and numbers have the notation of the standard; values are kept") {
  CHECK(formatted("[1a00Sub01]\nParameterName = x y \nObjectType=0x07\nDataType=5\nAccessType=RW\n"
                  "DefaultValue=0x180+$NodeID\nLowLimit=010\nHighLimit=0xff\n") ==
        "[1A00sub1]\nParameterName=x y\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\n"
        "DefaultValue=$NODEID+0x180\nLowLimit=010\nHighLimit=0xff\n");
  CHECK(formatted("[2000]\nDataType=five\nAccessType=often\nObjectType=\n") ==
        "[2000]\nDataType=five\nAccessType=often\nObjectType=\n");
  CHECK(formatted("[2000]\nDataType=010\n") == "[2000]\nDataType=010\n");  // either octal or a mistake
  CHECK(formatted("[2000] what\nDataType=5\nDataType=6\n") == "[2000] what\nDataType=0x0005\nDataType=6\n");
}

TEST_CASE("EDS normal form: keys and hexadecimal numbers have the spelling of the standard") {
  CHECK(formatted("[FILEINFO]\nFILENAME=x\nOwn key=1\n[deviceinfo]\nvendornumber=0X5\nbaudrate_125=1\n") ==
        "[FileInfo]\nFileName=x\nOwn key=1\n\n[DeviceInfo]\nVendorNumber=0X5\nbaudrate_125=1\n");
  CHECK(formatted("[2000]\nparametername=x\nDATATYPE=0X5\ndefaultvalue=0X10\nsubNumber=0\ncolour=red\n") ==
        "[2000]\nParameterName=x\nDataType=0x0005\nDefaultValue=0x10\nSubNumber=0\ncolour=red\n");
  CHECK(formatted("[2000]\nDataType=9\nDefaultValue=0X10\n") == "[2000]\nDataType=0x0009\nDefaultValue=0X10\n");
}

TEST_CASE("EDS normal form: counts of lists and sub-objects are corrected") {
  CHECK(formatted("[ManufacturerObjects]\nSupportedObjects=7\n1=0x2000\n2=0x200a\n\n[2000]\nSubNumber=9\n\n"
                  "[2000sub0]\nDataType=5\n\n[2000subFF]\nDataType=7\n\n[2000Value]\nNrOfEntries=0x1\n2=5\n") ==
        "[ManufacturerObjects]\nSupportedObjects=2\n1=0x2000\n2=0x200A\n\n[2000]\nSubNumber=1\n\n"
        "[2000sub0]\nDataType=0x0005\n\n[2000subFF]\nDataType=0x0007\n\n[2000Value]\nNrOfEntries=0x1\n2=5\n");
  CHECK(formatted("[2000]\nSubNumber=9\nCompactSubObj=8\n\n[2000sub1]\nDataType=0x0005\n").find("SubNumber=9") !=
        std::string::npos);
  CHECK(formatted("[Comments]\nLines=1\nLine1=\nLine2=\n") == "[Comments]\nLines=2\nLine1=\nLine2=\n");
}

TEST_CASE("EDS normal form: line ends and encoding are those of the file") {
  CHECK(formatted("[Mine]\r\nx=\xF6\r\n[2000]\r\nParameterName=\x94") ==
        "[2000]\r\nParameterName=\x94\r\n\r\n[Mine]\r\nx=\xF6\r\n");
  CHECK(formatted("\xEF\xBB\xBF[2000]\nParameterName=a\n[FileInfo]\n") ==
        "\xEF\xBB\xBF[FileInfo]\n\n[2000]\nParameterName=a\n");
  CHECK(formatted("x=1\n[2000]\nparameters\n") == "x=1\n\n[2000]\nparameters\n");
  CHECK(formatted("").empty());
}

TEST_CASE("EDS normal form: bytes of a byte order mark have no meaning behind the beginning of the file") {
  const std::string mark = "\xEF\xBB\xBF";
  CHECK(formatted(mark + " [2000h]\n") == mark + "[2000]\n");
  for (const char* before : {"\n", " "}) {
    const std::string once = formatted(before + mark + "[2000h]\n");
    CHECK(once == "\n" + mark + "[2000h]\n");
    CHECK(formatted(once) == once);
  }
}

TEST_CASE("EDS normal form: $NODEID in a text is kept") {
  for (const char* type : {"0x0009", "0x000A", "0x000B", "0x000F", "0x0008"}) {
    CAPTURE(type);
    const std::string text = std::string("[2000]\nDataType=") + type + "\nDefaultValue=1+$NodeID\n";
    CHECK(formatted(text) == text);
  }
  CHECK(formatted("[2000]\nDataType=0x0007\nDefaultValue=1+$NodeID\n") ==
        "[2000]\nDataType=0x0007\nDefaultValue=$NODEID+0x1\n");
  CHECK(formatted("[2000]\nDefaultValue=1+$NodeID\n") == "[2000]\nDefaultValue=$NODEID+0x1\n");
}

TEST_CASE("EDS normal form: a comment that suppresses a rule for one section is not moved to the top of the file") {
  const std::string once = formatted(
      "[2000]\nParameterName=a\n; codict: ignore eds-file-date\n[FileInfo]\nFileName=x\n[1000]\nParameterName=b\n");
  CHECK(once ==
        "[1000]\nParameterName=b\n\n; codict: ignore eds-file-date\n[FileInfo]\nFileName=x\n\n"
        "[2000]\nParameterName=a\n");
  CHECK(formatted(once) == once);
  CHECK(formatted("; codict: ignore od-limit\n[2000]\nParameterName=a\n; codict: ignored\n[FileInfo]\n") ==
        "; codict: ignore od-limit\n; codict: ignored\n\n[FileInfo]\n\n[2000]\nParameterName=a\n");
}

TEST_CASE("EDS normal form: comments of the section that becomes the first one are comments of the file") {
  const std::string once = formatted("[Mine]\nx=1\n; The object\n[2000]\nParameterName=a\n");
  CHECK(once == "; The object\n\n[2000]\nParameterName=a\n\n[Mine]\nx=1\n");
  CHECK(formatted(once) == once);
  const std::string both = formatted("; Top\n[2000]\nParameterName=a\n; File\n[FileInfo]\nFileName=x\n");
  CHECK(both == "; Top\n; File\n\n[FileInfo]\nFileName=x\n\n[2000]\nParameterName=a\n");
  CHECK(formatted(both) == both);
}

TEST_CASE("EDS normal form: invalid numbers are kept") {
  const std::string text = "[FileInfo]\nFileVersion=1.2.3\n\n[DeviceInfo]\nNrOfRXPDO=many\nGranularity=8 ; bits\n";
  CHECK(formatted(text) == text);
}
