// SPDX-License-Identifier: Apache-2.0
// Symbols that the application has to define, and their stubs.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "directory.hpp"
#include "gen/gen.hpp"
#include "generating.hpp"
#include "xdd_reading.hpp"

using namespace lexican::codict;

namespace {

// Generates from a description of CANopenNode, in which an object without a value has no memory.
gen::Output generate_xdd(const std::string& objects, gen::Language language) {
  const std::string parameters =
      "<parameter uniqueID=\"RAM\" access=\"read\"><USINT/><defaultValue value=\"1\"/>"
      "<property name=\"CO_storageGroup\" value=\"RAM\"/></parameter>"
      "<parameter uniqueID=\"OWN\" access=\"readWrite\"><UINT/><defaultValue value=\"5\"/>"
      "<property name=\"CO_extensionIO\" value=\"true\"/></parameter>";
  const std::string node = "<CANopenObject index=\"5FFF\" name=\"Node\" objectType=\"7\" uniqueIDRef=\"RAM\"/>";
  const test::XmlReading reading(test::xdd_with(objects + node, parameters));
  Findings findings;
  gen::Options options;
  options.name = "small";
  options.source = "small.xdd";
  options.language = language;
  return gen::generate(reading.device, options, findings);
}

std::string symbols_of(const gen::Output& output) {
  std::string names;
  for (const gen::External& external : output.externals) {
    names += external.name + "\n";
  }
  return names;
}

std::string variable(const char* index, const char* type, const char* access, const char* rest = "") {
  return fmt::format(
      "<CANopenObject index=\"{}\" name=\"Value\" objectType=\"7\" dataType=\"{}\" accessType=\"{}\" {}/>", index, type,
      access, rest);
}

// Returns the messages of the compiler, empty if it succeeds.
std::string compiled(const test::Directory& directory, const std::string& source, gen::Language language) {
  const bool is_c = language == gen::Language::c;
  const std::string command = fmt::format(
      "{} -Wall -Wextra -Wpedantic -Wconversion -Werror -fsyntax-only -DUSE_TIME=1 -I{}/include -I{}/config {} 2>{}",
      is_c ? LEXICAN_CC " -std=c11" : LEXICAN_CXX " -std=c++17", LEXICAN_SOURCE_DIR, LEXICAN_SOURCE_DIR,
      directory / source.c_str(), directory / "log");
  if (std::system(command.c_str()) == 0) {
    return {};
  }
  std::ifstream log(directory / "log");
  return {std::istreambuf_iterator<char>(log), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_CASE("gen: objects that the stack reads and writes are never external") {
  std::string objects =
      "<CANopenObject index=\"1003\" name=\"Errors\" objectType=\"8\" subNumber=\"2\">"
      "<CANopenSubObject subIndex=\"00\" name=\"Number\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>"
      "<CANopenSubObject subIndex=\"01\" name=\"Error\" objectType=\"7\" dataType=\"0007\" accessType=\"ro\"/>"
      "</CANopenObject>";
  const gen::Output plain =
      generate_xdd(variable("1001", "0005", "ro") + objects + variable("1017", "0006", "rw"), gen::Language::c);
  CHECK(symbols_of(plain) == "");
  CHECK(plain.files.at(1).bytes.find("&small_ram.od_1003_0") != std::string::npos);
}

TEST_CASE("gen: the stubs define all application-defined symbols and compile in both languages") {
  const std::string objects = variable("2000", "000F", "rw") + variable("2001", "0009", "ro") +
                              variable("2002", "0009", "rw") + variable("2003", "000B", "rw") +
                              variable("2004", "0008", "rw") + variable("2005", "000C", "rw") +
                              variable("2006", "0077", "rw") + variable("2007", "0001", "rw") +
                              "<CANopenObject index=\"6000\" name=\"*/ Type\" objectType=\"7\" uniqueIDRef=\"OWN\"/>";
  for (const gen::Language language : {gen::Language::c, gen::Language::cpp}) {
    const test::Directory directory;
    const gen::Output output = generate_xdd(objects, language);
    REQUIRE(output.files.size() == 2);
    CHECK(symbols_of(output) ==
          "small_2000_0\nsmall_2001_0\nsmall_2002_0\nsmall_2003_0\nsmall_2004_0\nsmall_2005_0\nsmall_2006_0_type\n"
          "small_2007_0\nsmall_6000_0_type\n");
    const std::string stubs = language == gen::Language::c ? "stubs.c" : "stubs.cpp";
    std::ofstream(directory / output.files[0].name.c_str()) << output.files[0].bytes;
    std::ofstream(directory / stubs.c_str()) << output.stubs;
    CHECK(compiled(directory, stubs, language) == "");
    std::ofstream(directory / ("verify_" + stubs).c_str()) << output.verify;
    CHECK(compiled(directory, "verify_" + stubs, language) == "");
    for (const gen::External& external : output.externals) {
      CHECK_MESSAGE(output.stubs.find(" " + external.name + " =") + output.stubs.find(" " + external.name + ";") !=
                        2 * std::string::npos,
                    external.name);
    }
  }
}
