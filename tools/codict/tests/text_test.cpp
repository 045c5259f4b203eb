// SPDX-License-Identifier: Apache-2.0
// Places, edits, findings and files.
#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "text/edit.hpp"
#include "text/encoding.hpp"
#include "text/file.hpp"
#include "text/finding.hpp"
#include "text/source.hpp"

using namespace lexican::codict;

namespace {

constexpr Rule first_rule{"test-first", Severity::warning, ""};
constexpr Rule second_rule{"test-second", Severity::error, ""};

class Directory {
 public:
  Directory() : path_(std::filesystem::temp_directory_path() / ("codict-test-" + std::to_string(::getpid()))) {
    std::filesystem::create_directory(path_);
  }
  ~Directory() { std::filesystem::remove_all(path_); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
  std::string operator/(const char* name) const { return path_ / name; }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_CASE("a source returns line and column of each byte") {
  const Source source("x", "ab\r\n\ncd");
  CHECK(source.lines() == 3);
  CHECK(source.slice(source.line(1)) == "ab");
  CHECK(source.slice(source.line(2)).empty());
  CHECK(source.slice(source.line(3)) == "cd");
  CHECK(source.position(0).line == 1);
  CHECK(source.position(4).line == 2);
  CHECK(source.position(6).line == 3);
  CHECK(source.position(6).column == 2);
  CHECK(source.position(7).column == 3);
  CHECK(Source("x", "").lines() == 1);
}

TEST_CASE("lines of a source without LF end with CR") {
  const Source source("x", "ab\r\rcd");
  CHECK(source.lines() == 3);
  CHECK(source.slice(source.line(1)) == "ab");
  CHECK(source.slice(source.line(2)).empty());
  CHECK(source.slice(source.line(3)) == "cd");
  CHECK(source.position(5).line == 3);
  CHECK(source.position(5).column == 2);
}

TEST_CASE("a finding names no-break spaces, which look like blanks") {
  Findings findings;
  findings.add(first_rule, {}, u8"'5\u00A0' is not a number", "write a number");
  CHECK(findings.all().at(0).text == "'5<U+00A0>' is not a number");
  CHECK(findings.all().at(0).hint == "remove the no-break space (U+00A0), or write a number");
}

TEST_CASE("edits change only their spans, in any order") {
  Edits edits;
  edits.replace({4, 5}, "E");
  edits.insert(0, "<");
  edits.insert(2, "1");
  edits.insert(2, "2");
  edits.replace({1, 2}, "");
  CHECK(edits.applied_to("abcdef") == "<a12cdEf");
  CHECK(Edits().applied_to("abc") == "abc");
}

TEST_CASE("equal findings are folded") {
  Findings findings;
  findings.add(first_rule, {5, 6}, "same");
  findings.add(second_rule, {3, 4}, "same");
  findings.add(first_rule, {1, 2}, "same");
  findings.add(first_rule, {2, 2}, "other");
  findings.sort();
  const std::vector<FoldedFindings> folded = fold(findings.all());
  REQUIRE(folded.size() == 3);
  CHECK(folded[0].first->span.begin == 1);
  CHECK(folded[0].more == 1);
  CHECK(folded[1].first->text == "other");
  CHECK(findings.count(first_rule) == 3);
  CHECK(findings.count(Severity::error) == 1);
}

TEST_CASE("findings beyond the limit are counted by rule") {
  Findings findings;
  for (std::size_t n = 0; n < Findings::most + 3; ++n) {
    findings.add(first_rule, {}, "again");
  }
  CHECK(findings.all().size() == Findings::most);
  CHECK(findings.dropped().at(&first_rule) == 3);
  CHECK(findings.count(first_rule) == Findings::most + 3);
  CHECK(findings.count(first_rule.severity) == Findings::most + 3);
}

TEST_CASE("notes and warnings beyond the limit replace no error") {
  Findings findings;
  for (std::size_t n = 0; n < Findings::most + 3; ++n) {
    findings.add(first_rule, {}, "again");
  }
  findings.add(second_rule, {}, "an error");
  CHECK(findings.count(second_rule) == 1);
  CHECK(findings.all().back().text == "an error");
  CHECK(findings.dropped().count(&second_rule) == 0);
}

TEST_CASE("an encoding is guessed from the bytes") {
  CHECK(guess_encoding("plain") == Encoding::ascii);
  CHECK(guess_encoding(u8"Größe") == Encoding::utf8);
  CHECK(guess_encoding("\xEF\xBB\xBF[x]") == Encoding::utf8);
  CHECK(guess_encoding("Gr\x94\xE1\x65") == Encoding::cp850);
  CHECK(guess_encoding("Gr\xF6\xDF\x65") == Encoding::cp1252);
  CHECK(guess_encoding("20 \xB0\x43") == Encoding::cp1252);
  CHECK(guess_encoding("\xC3") == Encoding::cp1252);        // incomplete UTF-8 character
  CHECK(guess_encoding("\xED\xA0\x80") != Encoding::utf8);  // surrogate, which is no character
  CHECK(guess_encoding("\xC0\x80") != Encoding::utf8);      // overlong encoding
  CHECK(guess_encoding("\xFE\xFF") == Encoding::utf16);
}

TEST_CASE("text is decoded and encoded without loss") {
  CHECK(to_utf8("Gr\x94\xE1\x65", Encoding::cp850) == u8"Größe");
  CHECK(to_utf8("\x80 5", Encoding::cp1252) == u8"€ 5");
  CHECK(to_utf8("a\xFFz", Encoding::utf8) == u8"a�z");
  std::string bytes;
  CHECK(from_utf8(u8"€ 5 für Öl", Encoding::cp1252, bytes));
  CHECK(bytes == "\x80 5 f\xFCr \xD6l");
  CHECK(from_utf8(u8"Öl", Encoding::utf8, bytes));
  CHECK(bytes == u8"Öl");
  CHECK_FALSE(from_utf8(u8"Ω", Encoding::cp1252, bytes));
  CHECK_FALSE(from_utf8("\xFF", Encoding::utf8, bytes));
}

TEST_CASE("a file is replaced as a whole, and not written without a change") {
  const Directory directory;
  const std::string path = directory / "device.eds";
  std::string why;
  CHECK(write_file(path, "one\n", why) == Written::yes);
  CHECK(read(path) == "one\n");
  const auto before = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
  std::filesystem::last_write_time(path, before);
  CHECK(write_file(path, "one\n", why) == Written::unchanged);
  CHECK(std::filesystem::last_write_time(path) == before);
  ::chmod(path.c_str(), 0640);
  CHECK(write_file(path, "two\n", why) == Written::yes);
  CHECK(read(path) == "two\n");
  struct stat status {};
  ::stat(path.c_str(), &status);
  CHECK((status.st_mode & 0777U) == 0640U);
  CHECK(directory.files() == 1);
}

TEST_CASE("the target of a symbolic link is written, and the link stays") {
  const Directory directory;
  std::string why;
  write_file(directory / "target", "one", why);
  std::filesystem::create_symlink("target", directory / "link");
  CHECK(write_file(directory / "link", "two", why) == Written::yes);
  CHECK(std::filesystem::is_symlink(directory / "link"));
  CHECK(read(directory / "target") == "two");
}

TEST_CASE("a text is shortened to a number of characters with an ellipsis at its end") {
  CHECK(shortened_to("speed", 5) == "speed");
  CHECK(shortened_to("speeds", 5) == "spee…");
  CHECK(shortened_to("größer", 6) == "größer");
  CHECK(shortened_to("größere", 6) == "größe…");
  CHECK(shortened_to("", 0) == "");
  CHECK(shortened_to("speed", 1) == "…");
  CHECK(shortened_to("speed", 0) == "…");
  CHECK(shortened_to("\x80\x80\x80", 2) == "\x80\x80\x80");  // bytes that begin no character
}

TEST_CASE("a file that cannot be read or written is reported in one line") {
  const Directory directory;
  std::string why;
  CHECK_FALSE(read_file(directory / "missing", why));
  CHECK(why.find("missing: No such file") != std::string::npos);
  why.clear();
  CHECK_FALSE(read_file(directory / "", why));
  CHECK(why.find("directory") != std::string::npos);
  CHECK(write_file(directory / "no/such/place", "x", why) == Written::no);
  CHECK(why.find("No such file") != std::string::npos);
}
